/* The line protocol of raycert: reads a case a line, answers each with a line, flushed, in order.
 *
 * A double travels as a string of 16 hexadecimal digits, its bit pattern, because C has no JSON
 * reader and this one would be longer if it read decimals. Any key order, blanks, escapes and
 * unknown fields are read. Infinity is null.
 */
#include "tracer.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 1000 };    /* nesting that is read; what is deeper gets an error, not a crash */

/* ---- memory, all of it given back after each line */

typedef struct Kept { struct Kept *before; max_align_t data[]; } Kept;
static Kept *kept;

void *keep(size_t bytes)
{
    Kept *block = malloc(sizeof *block + bytes);
    if (!block) {
        fputs("out of memory\n", stderr);
        exit(EXIT_FAILURE);
    }
    block->before = kept;
    kept = block;
    return block->data;
}

static void release(void)
{
    while (kept) {
        Kept *before = kept->before;
        free(kept);
        kept = before;
    }
}

/* ---- JSON: a value is its text, and the values in it */

typedef struct Value {
    const char *text;
    size_t length;
    struct Value *key;      /* of a member of an object, else NULL */
    struct Value *first;    /* of an object or an array: what is in it */
    struct Value *next;     /* beside this one */
} Value;

static const char *at;      /* what is not read yet of the line; NUL at its end */

static Value *value(int depth);

static char peek(void)
{
    at += strspn(at, " \t\r\n");
    return *at;
}

static bool string(void)
{
    for (at++; *at != '"'; at++) {
        if (*at == '\\') {
            at++;
            if (*at == 'u' && strspn(at + 1, "0123456789abcdefABCDEF") < 4)
                return false;
        }
        if (!*at)
            return false;
    }
    at++;
    return true;
}

static bool members(Value *parent, char close, int depth)
{
    Value **last = &parent->first;
    at++;
    if (peek() == close) {
        at++;
        return true;
    }
    do {
        Value *key = NULL;
        if (close == '}') {
            key = value(depth);
            if (!key || *key->text != '"' || peek() != ':')
                return false;
            at++;
        }
        Value *item = value(depth);
        if (!item)
            return false;
        item->key = key;
        *last = item;
        last = &item->next;
    } while (peek() == ',' && at++);
    return *at++ == close;
}

/* The value that comes next, NULL where there is none. Words and numbers are taken as they come:
 * none of them means anything here. */
static Value *value(int depth)
{
    char first = peek();
    Value *v = keep(sizeof *v);
    *v = (Value){.text = at};
    if (first == '{' || first == '[') {
        if (depth == 0 || !members(v, first == '{' ? '}' : ']', depth - 1))
            return NULL;
    } else if (first == '"') {
        if (!string())
            return NULL;
    } else {
        at += strspn(at, "+-.0123456789aeflnrstuE");
        if (at == v->text)
            return NULL;
    }
    v->length = (size_t)(at - v->text);
    return v;
}

/* Whether a string is this word, which is plain ASCII. */
static bool is(const Value *v, const char *word)
{
    if (!v || *v->text != '"')
        return false;
    for (const char *c = v->text + 1; *c != '"'; c++, word++) {
        unsigned code = (unsigned char)*c;
        if (code == '\\') {
            code = (unsigned char)*++c;
            if (code == 'u') {
                char digits[5] = {c[1], c[2], c[3], c[4]};
                code = (unsigned)strtoul(digits, NULL, 16);
                c += 4;
            } else if (strchr("bfnrt", *c)) {
                return false;   /* a control character */
            }
        }
        if (!*word || code != (unsigned char)*word)
            return false;
    }
    return !*word;
}

static const Value *member(const Value *object, const char *name)
{
    for (const Value *v = object ? object->first : NULL; v; v = v->next)
        if (is(v->key, name))
            return v;
    return NULL;
}

/* ---- the case: the first fault found is kept, and is the reply */

static char fault[80];
static const Value *unknown;    /* the type of a solid that this client does not have */

static void wrong(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (!*fault)
        vsnprintf(fault, sizeof fault, format, arguments);
    va_end(arguments);
}

static double number(const Value *v, const char *name)
{
    double x = NAN;
    if (v && v->length == 18 && strspn(v->text + 1, "0123456789abcdefABCDEF") == 16) {
        uint64_t bits = strtoull(v->text + 1, NULL, 16);    /* up to the closing quote */
        memcpy(&x, &bits, sizeof x);
    }
    if (!isfinite(x))
        wrong("%s: a string of 16 hexadecimal digits, a finite number, is wanted", name);
    return x;
}

static Vector vector(const Value *object, const char *name)
{
    const Value *v = member(object, name), *x = v ? v->first : NULL;
    const Value *y = x ? x->next : NULL, *z = y ? y->next : NULL;
    if (!z || z->next) {
        wrong("%s: three numbers are wanted", name);
        return (Vector){0, 0, 0};
    }
    return (Vector){number(x, name), number(y, name), number(z, name)};
}

static Solid solid(const Value *form)
{
    static const char *const names[] = {    /* in the order of Type */
        "half_space", "sphere", "infinite_cylinder", "slab", "cylinder",
        "union", "intersection", "difference",
    };
    const Value *type = member(form, "type");
    Solid s = {.type = HALF_SPACE};
    while (s.type <= DIFFERENCE && !is(type, names[s.type]))
        s.type++;
    if (s.type > DIFFERENCE) {
        if (type)
            unknown = type;
        else
            wrong("solid: its type is missing");
    } else if (s.type == HALF_SPACE) {
        s.point = vector(form, "point");
        s.normal = vector(form, "normal");
    } else if (s.type == SPHERE) {
        s.center = vector(form, "center");
    } else if (s.type <= CYLINDER) {
        s.p = vector(form, "p");
        s.q = vector(form, "q");
    } else {
        const Value *of = member(form, "of"), *first = of ? of->first : NULL;
        for (const Value *part = first; part; part = part->next)
            s.parts++;
        s.of = keep(s.parts * sizeof *s.of);
        size_t i = 0;
        for (const Value *part = first; part; part = part->next)
            s.of[i++] = solid(part);
        if (!s.parts)
            wrong("of: one solid or more is wanted");
    }
    if (s.type == SPHERE || s.type == INFINITE_CYLINDER || s.type == CYLINDER)
        s.radius = number(member(form, "radius"), "radius");
    return s;
}

/* ---- the answer */

static void say(double t)
{
    uint64_t bits;
    memcpy(&bits, &t, sizeof bits);
    if (isinf(t))
        fputs("null", stdout);
    else
        printf("\"%016" PRIx64 "\"", bits);
}

static void answer(void)
{
    const Value *form = value(DEEPEST);
    if (!form || *form->text != '{' || peek()) {
        puts("{\"error\": \"the line is not one JSON object\"}");
        return;
    }
    if (member(form, "hello")) {
        puts(HELLO);
        return;
    }
    const Value *id = member(form, "id"), *ray = member(form, "ray");
    *fault = '\0';
    unknown = NULL;
    Solid s = solid(member(form, "solid"));
    Ray r = {vector(ray, "origin"), vector(ray, "direction")};
    fputs("{\"id\": ", stdout);
    if (id)
        fwrite(id->text, 1, id->length, stdout);
    else
        fputs("null", stdout);
    if (unknown) {
        fputs(", \"unsupported\": ", stdout);
        fwrite(unknown->text, 1, unknown->length, stdout);
    } else if (*fault) {
        printf(", \"error\": \"%s\"", fault);
    } else {
        Pairs pairs = intersect(&s, &r);
        fputs(", \"intervals\": [", stdout);
        for (size_t i = 0; i < pairs.count; i++) {
            fputs(i ? ", [" : "[", stdout);
            say(pairs.at[i].enter);
            fputs(", ", stdout);
            say(pairs.at[i].leave);
            putchar(']');
        }
        putchar(']');
    }
    puts("}");
}

/* Whether there is one more line of standard input; it grows with the longest. */
static bool read_line(char **line, size_t *size)
{
    size_t length = 0;
    for (int c = getchar(); c != '\n'; c = getchar()) {
        if (c == EOF && length == 0)
            return false;
        if (c == EOF)
            break;
        if (length + 1 >= *size) {
            *size = 2 * *size + 4096;
            *line = realloc(*line, *size);
            if (!*line)
                return false;
        }
        (*line)[length++] = (char)c;
    }
    if (*line)
        (*line)[length] = '\0';
    return true;
}

int main(void)
{
    char *line = NULL;
    size_t size = 0;
    while (read_line(&line, &size)) {
        at = line ? line : "";
        answer();
        fflush(stdout);
        release();
    }
    free(line);
    return 0;
}
