#include "simpletools.h"

typedef void (*handler)(int);
static int seen[4];

void note(int n) { seen[n & 3]++; }
void apply(handler f, int n) { f(n); }
int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

int main()
{
  int low_ = 0, high_ = 0;
  int *best = &seen[1];
  handler chosen = note;
  int *same = (&low_), *other = ( /* ( */ (&high_));
  while (1) {
    apply(chosen, *best + *same + *other);
    apply(&note, 2);
    qsort(seen, 4, sizeof(int), compare);
    input_pair(&low_, &high_);
    register_handler(note);
  }
}
