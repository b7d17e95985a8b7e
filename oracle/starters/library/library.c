/* Binds tracer.c, the tracer of the C starter, to the signatures of raycert.h. */
#include "raycert.h"
#include "tracer.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

/* ---- memory, all of it given back after each answer */

typedef struct Kept { struct Kept *before; max_align_t data[]; } Kept;
static Kept *kept;

void *keep(size_t bytes)
{
    Kept *block = malloc(sizeof *block + bytes);
    if (!block)
        abort();
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

/* ---- the question: what is not read yet of the two arrays */

typedef struct { const int32_t *word, *words_end; const double *number, *numbers_end; } Rest;

static bool vector(Rest *rest, Vector *to)
{
    if (rest->numbers_end - rest->number < 3)
        return false;
    *to = (Vector){rest->number[0], rest->number[1], rest->number[2]};
    rest->number += 3;
    return true;
}

static bool real(Rest *rest, double *to)
{
    if (rest->number == rest->numbers_end)
        return false;
    *to = *rest->number++;
    return true;
}

static int solid(Rest *rest, Solid *s);

static int parts(Rest *rest, Solid *s)
{
    if (rest->word == rest->words_end || *rest->word < 1)
        return RAYCERT_ERROR;
    s->parts = (size_t)*rest->word++;
    s->of = keep(s->parts * sizeof *s->of);
    for (size_t i = 0; i < s->parts; i++) {
        int wrong = solid(rest, &s->of[i]);
        if (wrong)
            return wrong;
    }
    return 0;
}

/* Reads the next solid; returns 0, or what to return for it. */
static int solid(Rest *rest, Solid *s)
{
    if (rest->word == rest->words_end)
        return RAYCERT_ERROR;
    int32_t code = *rest->word++;
    if (code < RAYCERT_HALF_SPACE || code > RAYCERT_DIFFERENCE)
        return RAYCERT_UNSUPPORTED;
    *s = (Solid){.type = (Type)(code - RAYCERT_HALF_SPACE)};    /* in the same order */
    bool whole = true;
    switch (s->type) {
    case HALF_SPACE:
        whole = vector(rest, &s->point) && vector(rest, &s->normal);
        break;
    case SPHERE:
        whole = vector(rest, &s->center) && real(rest, &s->radius);
        break;
    case INFINITE_CYLINDER:
    case CYLINDER:
        whole = vector(rest, &s->p) && vector(rest, &s->q) && real(rest, &s->radius);
        break;
    case SLAB:
        whole = vector(rest, &s->p) && vector(rest, &s->q);
        break;
    default:
        return parts(rest, s);
    }
    return whole ? 0 : RAYCERT_ERROR;
}

/* ---- the two functions */

int raycert_intersect(const int32_t *words, int32_t length, const double *numbers, int32_t count,
                      const double origin[3], const double direction[3], double *out,
                      int32_t capacity)
{
    Rest rest = {words, words + length, numbers, numbers + count};
    Solid s;
    int result = solid(&rest, &s);
    if (result == 0) {
        Ray ray = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}};
        Pairs pairs = intersect(&s, &ray);
        for (size_t i = 0; i < pairs.count && i < (size_t)capacity; i++) {
            out[2 * i] = pairs.at[i].enter;
            out[2 * i + 1] = pairs.at[i].leave;
        }
        result = (int)pairs.count;
    }
    release();
    return result;
}

const char *raycert_hello(void) { return HELLO; }
