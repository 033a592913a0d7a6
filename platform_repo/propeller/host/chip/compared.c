/* What the user's program compares: for each comparison in its text the least and the most by which the left side was greater than
 * the right one in this run. The compiler calls the hooks (-fsanitize-coverage=trace-cmp) with both sides. The difference tells how
 * far a program is from going another way, which its coverage does not. */
#include <math.h>
#include <string.h>
#include "chip.h"

enum { PLACES = 1 << 12 };
static struct { unsigned place; float least, most; } compared[PLACES];
static unsigned known;

/* Places are addresses in the program's code, of cases of a switch in its data; they are the same in each run. */
static void note(unsigned place, double difference) {
  unsigned at = place * 2654435761u >> 20;
  if (!cogs_started() || difference != difference) return;
  while (compared[at].place && compared[at].place != place) at = (at + 1) % PLACES;
  if (!compared[at].place) {
    if (++known > PLACES / 2) return;
    compared[at].place = place;
    compared[at].least = compared[at].most = (float)difference;
    return;
  }
  if (difference < compared[at].least) compared[at].least = (float)difference;
  if (difference > compared[at].most) compared[at].most = (float)difference;
}

void compared_tell(host_time when) {
  for (unsigned at = 0; at < PLACES; at++) {
    unsigned bits[2];
    if (!compared[at].place) continue;
    memcpy(bits, &compared[at].least, sizeof bits);
    link_record(when, RECORD_COMPARED, compared[at].place, bits[0], bits[1]);
  }
}

#define PLACE ((unsigned)__builtin_return_address(0))
/* The compiler tells no signs: bytes are unsigned, as the platform's char, all others signed, as most of what programs count. Where
 * one side is a constant it comes first, whatever the text says. */
#define HOOK(name, unsigned_type, type) \
  void __sanitizer_cov_trace_##name(unsigned_type left, unsigned_type right) { note(PLACE, (double)(type)right - (double)(type)left); }
HOOK(cmp1, unsigned char, unsigned char)
HOOK(cmp2, unsigned short, short)
HOOK(cmp4, unsigned, int)
HOOK(cmp8, unsigned long long, long long)
HOOK(const_cmp1, unsigned char, unsigned char)
HOOK(const_cmp2, unsigned short, short)
HOOK(const_cmp4, unsigned, int)
HOOK(const_cmp8, unsigned long long, long long)
HOOK(cmpf, float, float)
HOOK(cmpd, double, double)

void __sanitizer_cov_trace_switch(unsigned long long value, unsigned long long *cases) {
  for (unsigned long long i = 0; i < cases[0]; i++)
    note((unsigned)&cases[2 + i], cases[1] == 8 ? (double)value - (double)cases[2 + i] : (double)(int)value - (double)(int)cases[2 + i]);
}
