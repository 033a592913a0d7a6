// expect D9=1 D8=1 D7=2 D6=1
#include <stdlib.h>
#include "simpletools.h"
int turned[] = {2, 0, 1};
int sorted[] = {2, 1, 0};
int moved[] = {3, 3};
int filled[] = {3, 3};
int order(const void *a, const void *b) { return *(int *)a - *(int *)b; }
void turn(int *a, int n) { for (int i = 0; i < n / 2; i++) { int x = a[i]; a[i] = a[n - 1 - i]; a[n - 1 - i] = x; } }
void pulse(int pin) { high(pin); pause(2); low(pin); pause(2); }

int main() {
  int *p = moved;
  turn(turned, 3);
  pulse(turned[0]);
  qsort(sorted, 3, sizeof(int), order);
  pulse(sorted[0]);
  *(p + 1) = 2;
  pulse(moved[1]);
  filled[0] = 2;
  pulse(filled[0]);
  pulse(filled[1]);
  while (1);
}
