// What a tracer's answers are granted, by the golden rows alone: node judge.mjs FOLDER ANSWERS...
//
// It only compares numbers. FOLDER holds the golden files of one precision, ANSWERS what a tracer
// wrote in the line protocol: its hello (may be left out), and a reply a line. See README.md.
import { readFileSync, readdirSync } from 'node:fs';

const LEVELS = ['sound', 'stable', 'faithful', 'exact'];
const KINDS = ['tangent', 'wall', 'cap', 'rim', 'start'];
const TYPES = ['half_space', 'sphere', 'infinite_cylinder', 'slab', 'cylinder',
  'union', 'intersection', 'difference'];

// ---- reading

/** The number that a hexadecimal float such as -0x1.8p+1 spells. Halving and doubling are exact. */
function fromHex(text) {
  const [, sign, whole, part = '', power] =
    /^([-+]?)0x([0-9a-f]+)(?:\.([0-9a-f]*))?p([-+]?\d+)$/i.exec(text) ?? [];
  if (whole === undefined) return NaN;
  let x = parseInt(whole + part, 16);
  const shift = Number(power) - 4 * part.length;
  for (let i = 0; i < Math.abs(shift) && x && x < Infinity; i++) x *= shift < 0 ? 0.5 : 2;
  return sign === '-' ? -x : x;
}

function fromBits(text) {
  const view = new DataView(new ArrayBuffer(8));
  view.setBigUint64(0, BigInt(`0x${text}`));
  return text.length === 8 ? view.getFloat32(4) : view.getFloat64(0);
}

const READ = {
  decimal: (value) => (typeof value === 'number' ? value : NaN), hex: fromHex, bits: fromBits,
};

function number(value, hello) {
  if (value === null || value === 'inf' || value === 'Infinity') return Infinity;
  const x = READ[hello.numbers](value);
  return hello.precision === 'binary32' ? Math.fround(x) : x;
}

function pairs(list, hello = { numbers: 'hex' }) {
  if (!list.every((pair) => pair.length === 2)) throw new Error('not a list of pairs');
  return list.map((pair) => pair.map((value) => number(value, hello)));
}

/** Whether a solid has a radius of 0. */
const hasNoRadius = (solid) => (solid.of ? solid.of.some(hasNoRadius)
  : solid.radius !== undefined && fromHex(solid.radius) === 0);

const lines = (path) => readFileSync(path, 'latin1').split('\n').filter((line) => line);

/** What the verdict takes of a golden row. Its exact ends merge where they touch after rounding. */
function readRow(line) {
  const row = JSON.parse(line);
  const ends = [];
  for (const { enter, leave } of row.intervals) {
    const last = ends.at(-1);
    const [nearest] = pairs([[enter.nearest, last ? last[1].nearest : null]]);
    if (last && nearest[0] <= nearest[1]) last[1] = leave;
    else ends.push([enter, leave]);
  }
  const rounded = (way) => pairs(ends.map((pair) => pair.map((end) => end[way])));
  const accept = {};
  for (const level of ['sound', 'stable']) {
    const { inner, outer, most } = row.accept[level];
    accept[level] = { inner: pairs(inner), outer: pairs(outer), most };
  }
  return {
    id: row.id, tier: row.tier, solid: row.solid, decisive: row.decisive, accept,
    degenerate: hasNoRadius(row.solid) || row.ray.direction.every((x) => fromHex(x) === 0),
    touches: row.intervals.map((interval) => interval.touch),
    expected: pairs(row.expected), down: rounded('down'), up: rounded('up'),
  };
}

/** The hello and the answer to each id: a list of pairs, or null where that is not what it is. */
function readAnswers(path) {
  const hello = { numbers: 'decimal', precision: 'binary64', convention: 'closed', solids: TYPES };
  const answers = new Map();
  for (const line of lines(path)) {
    try {
      const reply = JSON.parse(line);
      if ('hello' in reply) Object.assign(hello, reply);
      else answers.set(reply.id, answers.has(reply.id) ? null : pairs(reply.intervals, hello));
    } catch { /* not a list of pairs of numbers */ }
  }
  return { hello, answers };
}

// ---- the rules

const within = (pair, other) => other[0] <= pair[0] && pair[1] <= other[1];

function wellFormed(row, answer) {
  const overflow = row.up.some(([enter]) => enter === Infinity);
  let last = -1;
  for (const [enter, leave] of answer) {
    if (!(enter >= 0 && last < enter && enter <= leave)) return false; // so is NaN refused
    if (enter === Infinity && !overflow) return false;
    last = leave;
  }
  const endless = row.down.at(-1)?.[1] === Infinity;
  return row.tier !== 'lattice' || !answer.length || endless === (last === Infinity);
}

const accepted = ({ inner, outer, most }, answer) =>
  answer.every((pair) => outer.some((other) => within(pair, other)))
  && inner.every((pair) => answer.some((other) => within(pair, other)))
  && outer.every((other, i) => answer.filter((pair) => within(pair, other)).length <= most[i]);

/** Whether a convention, such as `closed but rim`, keeps a kind of touch as a pair. */
function keeps(convention, kind) {
  const [base, but = ''] = convention.split(' but ');
  return (base === 'closed') !== but.split(/[ ,]+/).includes(kind);
}

/** The levels that an answer passes, whether the row decides them or not. */
function passes(row, answer, convention) {
  const { expected, down, up, touches } = row;
  const kept = [...expected.keys()].filter((i) => touches.length !== expected.length
    || touches[i] === null || keeps(convention, touches[i]));
  const each = (test) => kept.length === answer.length
    && kept.every((i, n) => [0, 1].every((end) => test(i, n, end)));
  return {
    sound: accepted(row.accept.sound, answer),
    stable: accepted(row.accept.stable, answer),
    faithful: each((i, n, end) => [down[i][end], up[i][end]].includes(answer[n][end])),
    exact: each((i, n, end) => expected[i][end] === answer[n][end]),
  };
}

function grade(row, answer, convention, tally) {
  tally.rows++;
  if (row.degenerate) return;
  const bad = !answer || !wellFormed(row, answer);
  const passed = bad ? {} : passes(row, answer, convention);
  let fails = bad;
  for (const level of row.tier === 'range' ? [] : LEVELS) {
    if (!bad && !row.decisive.includes(level)) continue;
    fails ||= !passed[level];
    tally[level][0] += !fails;
    tally[level][1]++;
  }
  for (const kind of answer && row.tier === 'lattice' ? new Set(row.touches) : []) {
    if (kind === null) continue;
    tally[kind][0] += answer.length > 0;
    tally[kind][1]++;
  }
}

/** Whether a client is asked about a solid: it declares its type, and those of all its parts. */
const asked = (solid, types) =>
  types.includes(solid.type) && (solid.of ?? []).every((part) => asked(part, types));

/**
 * Print, for each type of solid, the level granted, the convention, how many rows pass each level
 * of those that decide it, and how many touches are kept of all.
 */
function judge(rows, path) {
  const { hello, answers } = readAnswers(path);
  const more = [hello.domain, hello.degenerate].some((one) => Object.keys(one ?? {}).length)
    || /\bany\b/.test(hello.convention);
  if (hello.tolerance || more || (hello.answers ?? 'intervals') !== 'intervals') {
    throw new Error(`${path}: only lists of intervals with no tolerance, domain, degenerate inputs`
      + ' or touches left open are judged here');
  }
  let granted = true;
  let tested = false;
  for (const type of TYPES) {
    const tally = { rows: 0 };
    for (const key of [...LEVELS, ...KINDS]) tally[key] = [0, 0];
    for (const row of rows) {
      if (row.solid.type !== type || !asked(row.solid, hello.solids)) continue;
      grade(row, answers.get(row.id), hello.convention, tally);
    }
    if (!tally.rows) continue;
    tested = true;
    const failed = LEVELS.findIndex((key) => !tally[key][0] || tally[key][0] < tally[key][1]);
    const level = failed === -1 ? 'exact' : LEVELS[failed - 1] ?? 'refused';
    const [kept, all] = [0, 1].map((i) => KINDS.reduce((sum, kind) => sum + tally[kind][i], 0));
    const mixed = kept ? 'mixed' : 'regularized';
    const convention = !all ? 'not tested' : kept === all ? 'closed' : mixed;
    const counts = [LEVELS, KINDS].map((keys) =>
      keys.map((key) => `${key} ${tally[key].join('/')}`).join(' '));
    console.log([path, type, level, convention, ...counts].join('\t'));
    granted &&= failed !== 0 && kept === all;
  }
  return granted && tested;
}

function main(folder, ...files) {
  if (!files.length) throw new Error('usage: node judge.mjs FOLDER ANSWERS...');
  const golden = readdirSync(folder).filter((name) => name.endsWith('.jsonl'));
  const rows = golden.flatMap((name) => lines(`${folder}/${name}`).map(readRow));
  return files.map((path) => judge(rows, path)).every((granted) => granted);
}

try {
  process.exitCode = main(...process.argv.slice(2)) ? 0 : 1;
} catch (error) {
  console.error(`judge: ${error.message}`);
  process.exitCode = 2;
}
