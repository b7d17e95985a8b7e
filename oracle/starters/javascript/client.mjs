// The line protocol of raycert: reads a case a line, answers each with a line, flushed, in order.
//
// JSON.parse and JSON.stringify read and write every double exactly, so numbers are plain
// decimals; and JSON.stringify writes Infinity as null, which is what the protocol asks for.

import { hello, intersect } from "./tracer.mjs";

const VECTORS = {
  half_space: ["point", "normal"],
  sphere: ["center"],
  infinite_cylinder: ["p", "q"],
  slab: ["p", "q"],
  cylinder: ["p", "q"],
};
const ROUND = ["sphere", "infinite_cylinder", "cylinder"];
const TREES = ["union", "intersection", "difference"];

class Unsupported extends Error {}

function checkVector(form, name) {
  if (!Array.isArray(form[name]) || form[name].length !== 3 || !form[name].every(Number.isFinite))
    throw new Error(`${name} is not three numbers`);
}

// A solid is used as it came, once it is known to have what its type needs.
function checkSolid(solid) {
  if (typeof solid?.type !== "string") throw new Error("a solid has no type");
  if (TREES.includes(solid.type)) {
    if (!solid.of?.length) throw new Error("a tree has no parts");
    solid.of.forEach(checkSolid);
  } else if (Object.hasOwn(VECTORS, solid.type)) {
    for (const name of VECTORS[solid.type]) checkVector(solid, name);
    if (ROUND.includes(solid.type) && !Number.isFinite(solid.radius))
      throw new Error("radius is not a number");
  } else {
    throw new Unsupported(`solid type ${solid.type}`);
  }
}

function answer(line) {
  let id;
  try {
    const asked = JSON.parse(line);
    if (asked.hello !== undefined) return hello;
    id = asked.id;
    checkSolid(asked.solid);
    checkVector(asked.ray, "origin");
    checkVector(asked.ray, "direction");
    return { id, intervals: intersect(asked.solid, asked.ray) };
  } catch (error) {
    return { id, [error instanceof Unsupported ? "unsupported" : "error"]: error.message };
  }
}

// Lines are cut here, as node:readline also cuts at U+2028, which JSON allows in a string.
let rest = "";
process.stdin.setEncoding("utf8");
for await (const chunk of process.stdin) {
  const lines = (rest + chunk).split("\n");
  rest = lines.pop();
  for (const line of lines) process.stdout.write(JSON.stringify(answer(line)) + "\n");
}
if (rest) process.stdout.write(JSON.stringify(answer(rest)) + "\n");
