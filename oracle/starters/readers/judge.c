/* What a tracer's answers are granted, by the flat golden file alone: judge golden.tsv ANSWERS...
 *
 * It only compares numbers. The golden file's header says the rules, README.md the form of ANSWERS.
 */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SOUND, STABLE, FAITHFUL, EXACT, LEVELS, KINDS = 5, TYPES = 8, MOST = 2000 };
static const char *const LEVEL[] = {"sound", "stable", "faithful", "exact"};
static const char *const KIND[] = {"tangent", "wall", "cap", "rim", "start", "none"};
static const char *const TYPE[] = {"half_space", "sphere", "infinite_cylinder", "slab", "cylinder",
                                   "union", "intersection", "difference"};
typedef struct { int n; double of[MOST][2]; } Pairs;
static struct {
    char id[100], tier[10];
    int type, touches, touch[MOST], most[2][MOST];
    bool degenerate, decides[LEVELS], touched[KINDS + 1];
    Pairs expected, down, up, inner[2], outer[2];
} row;
typedef struct { int rows, passed[LEVELS], failed[LEVELS], kept[KINDS], touched[KINDS]; } Tally;
typedef struct {
    FILE *file;
    bool drops[KINDS + 1];                              /* the touches it declares to drop */
    Tally tally[TYPES];
} Tracer;
static bool narrow;                                     /* binary32: 8 digits a number */

static void die(const char *what, const char *why)
{
    fprintf(stderr, "judge: %s: %s\n", what, why);
    exit(2);
}

static int length(FILE *file)
{
    int n;
    if (fscanf(file, "%d", &n) != 1 || n < 0 || n > MOST) die(row.id, "a list has no good length");
    return n;
}

static double number(FILE *file)
{
    char digits[18];
    if (fscanf(file, " %17[0-9a-fA-F]", digits) != 1 || strlen(digits) != (narrow ? 8 : 16))
        die(row.id, "a number is not a bit pattern of the golden file's precision");
    uint64_t bits = strtoull(digits, NULL, 16);
    uint32_t low = (uint32_t)bits;
    double wide;
    float single;
    memcpy(&wide, &bits, sizeof wide);
    memcpy(&single, &low, sizeof single);
    return narrow ? single : wide;
}

static void pairs(FILE *file, Pairs *list)
{
    list->n = length(file);
    for (int i = 0; i < 2 * list->n; i++) list->of[i / 2][i % 2] = number(file);
}

static int word(FILE *file, const char *const *words, int n)
{
    char found[20] = "";
    if (fscanf(file, "%19s", found) == 1)
        for (int i = 0; i < n; i++)
            if (!strcmp(found, words[i])) return i;
    die(row.id, "a word is none of those that can be there");
    return 0;
}

/* Whether a solid has a radius of 0. */
static bool has_no_radius(FILE *file, int type)
{
    static const int numbers[] = {6, 4, 7, 6, 7};
    bool none = false;
    double last = 1;
    if (type >= (int)(sizeof numbers / sizeof *numbers)) {
        for (int n = length(file); n > 0; n--) none |= has_no_radius(file, word(file, TYPE, TYPES));
        return none;
    }
    for (int n = numbers[type]; n > 0; n--) last = number(file);
    return numbers[type] != 6 && last == 0;
}

static bool has_no_direction(FILE *file)
{
    bool none = true;
    for (int i = 0; i < 6; i++) none &= number(file) == 0 || i < 3;
    return none;
}

static bool read_row(FILE *file)
{
    memset(row.decides, 0, sizeof row.decides);
    memset(row.touched, 0, sizeof row.touched);
    while (fscanf(file, " %1[#]%*[^\n]", row.id) == 1) {}           /* comments */
    if (fscanf(file, "%99s %9s", row.id, row.tier) != 2) return false;
    row.type = word(file, TYPE, TYPES);
    row.degenerate = has_no_radius(file, row.type);
    row.degenerate |= has_no_direction(file);
    pairs(file, &row.expected);
    pairs(file, &row.down);
    pairs(file, &row.up);
    for (int n = length(file); n > 0; n--) row.decides[word(file, LEVEL, LEVELS)] = true;
    for (int level = SOUND; level <= STABLE; level++) {
        pairs(file, &row.inner[level]);
        pairs(file, &row.outer[level]);
        int n = length(file);
        for (int i = 0; i < n; i++) row.most[level][i] = length(file);
    }
    row.touches = length(file);
    for (int i = 0; i < row.touches; i++)
        row.touched[row.touch[i] = word(file, KIND, KINDS + 1)] = true;
    return true;
}

static bool read_answer(Tracer *tracer, Pairs *answer)
{
    char id[100] = "", dash[2];
    while (fscanf(tracer->file, "%99s", id) == 1 && !strcmp(id, "drops"))
        for (int n = length(tracer->file); n > 0; n--)
            tracer->drops[word(tracer->file, KIND, KINDS)] = true;
    if (strcmp(id, row.id)) die(row.id, "is not the next answer");
    if (fscanf(tracer->file, " %1[-]", dash) == 1) return false;
    pairs(tracer->file, answer);
    return true;
}

static bool well_formed(const Pairs *answer)
{
    bool overflow = false, endless = row.down.n && isinf(row.down.of[row.down.n - 1][1]);
    double last = -1;
    for (int i = 0; i < row.up.n; i++) overflow |= isinf(row.up.of[i][0]);
    for (int i = 0; i < answer->n; last = answer->of[i++][1]) {
        double enter = answer->of[i][0], leave = answer->of[i][1];
        if (!(0 <= enter && last < enter && enter <= leave)) return false;  /* so is NaN refused */
        if (isinf(enter) && !overflow) return false;
    }
    return strcmp(row.tier, "lattice") || !answer->n || endless == (isinf(last) != 0);
}

static bool within(const double *pair, const double *other)
{
    return other[0] <= pair[0] && pair[1] <= other[1];
}

static bool all_within(const Pairs *list, const Pairs *other)
{
    for (int i = 0, j; i < list->n; i++) {
        for (j = 0; j < other->n && !within(list->of[i], other->of[j]); j++) {}
        if (j == other->n) return false;
    }
    return true;
}

static bool accepted(const Pairs *answer, int level)
{
    const Pairs *outer = &row.outer[level];
    for (int i = 0, n; i < outer->n; i++) {
        for (int j = n = 0; j < answer->n; j++) n += within(answer->of[j], outer->of[i]);
        if (n > row.most[level][i]) return false;
    }
    return all_within(answer, outer) && all_within(&row.inner[level], answer);
}

/* Compare with the expected list, less the touches that the tracer declares to drop. */
static bool expected(const Pairs *answer, int level, const bool *drops)
{
    bool right = true;
    int n = 0;
    for (int i = 0; i < row.expected.n; i++) {
        if (row.touches == row.expected.n && drops[row.touch[i]]) continue;
        for (int end = 0; n < answer->n && end < 2; end++) {
            double x = answer->of[n][end];
            if (level == EXACT) right = right && x == row.expected.of[i][end];
            else right = right && (x == row.down.of[i][end] || x == row.up.of[i][end]);
        }
        n++;
    }
    return right && n == answer->n;
}

static void grade(Tracer *tracer)
{
    static Pairs answer;
    bool answered = read_answer(tracer, &answer), bad = !answered || !well_formed(&answer);
    bool fails = bad;
    Tally *tally = &tracer->tally[row.type];
    tally->rows++;
    if (row.degenerate) return;
    for (int i = SOUND; i < LEVELS && strcmp(row.tier, "range"); i++) {
        if (!bad && !row.decides[i]) continue;
        if (!fails)
            fails = !(i <= STABLE ? accepted(&answer, i) : expected(&answer, i, tracer->drops));
        (fails ? tally->failed : tally->passed)[i]++;
    }
    for (int k = 0; k < KINDS && answered && !strcmp(row.tier, "lattice"); k++) {
        tally->touched[k] += row.touched[k];
        tally->kept[k] += row.touched[k] && answer.n;
    }
}

/* Print, for each type of solid, the level granted, the convention, how many rows pass each level
 * of those that decide it, and how many touches are kept of all. */
static bool verdict(const char *path, const Tally *tally)
{
    bool granted = true, tested = false;
    for (int type = 0; type < TYPES; type++, tally++) {
        int level = 0, kept = 0, all = 0;
        if (!tally->rows) continue;
        tested = true;
        while (level < LEVELS && tally->passed[level] && !tally->failed[level]) level++;
        for (int k = 0; k < KINDS; k++) kept += tally->kept[k], all += tally->touched[k];
        printf("%s\t%s\t%s\t%s", path, TYPE[type], level ? LEVEL[level - 1] : "refused",
               !all ? "not tested" : kept == all ? "closed" : kept ? "mixed" : "regularized");
        for (int i = 0; i < LEVELS; i++)
            printf("%c%s %d/%d", i ? ' ' : '\t', LEVEL[i], tally->passed[i],
                   tally->passed[i] + tally->failed[i]);
        for (int k = 0; k < KINDS; k++)
            printf("%c%s %d/%d", k ? ' ' : '\t', KIND[k], tally->kept[k], tally->touched[k]);
        putchar('\n');
        granted = granted && level && kept == all;
    }
    return granted && tested;
}

static FILE *opened(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) die(path, "cannot be read");
    return file;
}

int main(int argc, char **argv)
{
    if (argc < 3) die("usage", "judge golden.tsv ANSWERS...");
    FILE *golden = opened(argv[1]);
    Tracer *tracers = calloc((size_t)argc, sizeof *tracers);
    char line[100] = "", rest[2];
    if (!tracers) die("memory", "there is none");
    for (int i = 2; i < argc; i++) tracers[i].file = opened(argv[i]);
    narrow = fgets(line, sizeof line, golden) && strstr(line, "binary32");
    rewind(golden);
    while (read_row(golden))
        for (int i = 2; i < argc; i++) grade(&tracers[i]);
    bool granted = true;
    for (int i = 2; i < argc; i++) {
        if (fscanf(tracers[i].file, "%1s", rest) == 1) die(argv[i], "has more answers than asked");
        granted &= verdict(argv[i], tracers[i].tally);
    }
    return granted ? 0 : 1;
}
