#include <stdio.h>
#include "mv.h"
int left, right;
int both;
int q1, q2; int q; int q1, q2, q; int w[3], *p; int w[], *p;
int main(void) { left = 1; right = 2; shared_one = 3; both = 4; pointer = &both; q1 = 5; q2 = 6; q = 7; w[2] = 8; p = w;
  move();
  printf("%d %d %d %d %d %d %d %d %d\n", left, right, shared_one, both, *pointer, q1, q2, q, p[2]); return 0; }
