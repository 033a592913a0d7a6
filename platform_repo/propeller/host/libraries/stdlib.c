/* stdlib.h: a heap as large as the chip's memory, random numbers, the end of the program, numbers from text. */
#include <stdlib.h>
#include <string.h>
#include "host.h"

int errno;  /* no function of the models sets it */

float strtof(const char *s, char **end);

/* ---- the heap: blocks one after the other, each with its size before it; free neighbours are joined when room is looked for */

enum { HEAP_BYTES = 32768, HEAD = 8 };
struct block { int size, used; };
static char heap[HEAP_BYTES] __attribute__((aligned(8)));
static int heap_ready;

static struct block *after(struct block *block) { return (struct block *)((char *)block + HEAD + block->size); }

static int is_inside(struct block *block) { return (char *)block < heap + HEAP_BYTES; }

void *malloc(size_t size) {
  struct block *block = (struct block *)heap;
  if (!heap_ready) *block = (struct block){HEAP_BYTES - HEAD, 0};
  heap_ready = 1;
  if (size > HEAP_BYTES) return 0;
  int wanted = ((int)size + 7) & ~7;
  for (; is_inside(block); block = after(block)) {
    if (block->used) continue;
    while (is_inside(after(block)) && !after(block)->used) block->size += HEAD + after(block)->size;
    if (block->size < wanted) continue;
    if (block->size >= wanted + 2 * HEAD) {
      int rest = block->size - wanted - HEAD;
      block->size = wanted;
      *after(block) = (struct block){rest, 0};
    }
    block->used = 1;
    return block + 1;
  }
  return 0;
}

void free(void *place) {
  if (!place) return;
  struct block *block = (struct block *)place - 1;
  if ((char *)block < heap || (char *)block >= heap + HEAP_BYTES || !block->used)
    host_end("crashed", "frees memory that was not allocated");
  block->used = 0;
}

void *calloc(size_t count, size_t size) {
  void *place = size && count > HEAP_BYTES / size ? 0 : malloc(count * size);
  return place ? memset(place, 0, count * size) : 0;
}

void *realloc(void *place, size_t size) {
  void *moved = malloc(size);
  if (moved && place) {
    size_t before = ((struct block *)place - 1)->size;
    memcpy(moved, place, before < size ? before : size);
    free(place);
  }
  return moved;
}

char *strdup(const char *s) {
  char *copy = malloc(strlen(s) + 1);
  return copy ? strcpy(copy, s) : 0;
}

/* ---- the rest */

/* Random numbers, as in lib/stdlib/rand.c: each cog has its own state. That of main begins with 0, that of any other cog with what its
 * stack holds, which is another value in each varied run. */
static unsigned int rand_states[8];
static unsigned char rand_ready[8] = {1};

static unsigned int *rand_state(void) {
  int cog = host_self();
  if (!rand_ready[cog]) srand(host_random());
  return &rand_states[cog];
}

int rand(void) {
  unsigned int *state = rand_state();
  *state = *state * 1103515245 + 12345;
  return *state >> 16 & RAND_MAX;
}

void srand(unsigned int seed) {
  rand_ready[host_self()] = 1;
  rand_states[host_self()] = seed;
}

void exit(int status) {
  (void)status;
  host_sleep_for_ever();
}

void _exit(int status) { exit(status); }

void abort(void) { host_end("crashed", "calls abort"); }

double atof(const char *s) { return strtof(s, 0); }

double strtod(const char *s, char **end) { return strtof(s, end); }

char *itoa(int i, char b[], int base) {
  char digits[34];
  int count = 0, at = 0;
  unsigned value = i < 0 ? -(unsigned)i : (unsigned)i;
  do digits[count++] = "0123456789ABCDEF"[value % base];
  while (value /= base);
  if (i < 0) b[at++] = '-';
  while (count) b[at++] = digits[--count];
  b[at] = 0;
  return b;
}
