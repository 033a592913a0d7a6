#include <stdio.h>
int state;
int step(int s) {
  switch (s) { case 0: case 1: return 2; case 70000: return 3; case -1: { int k; for (k = 0; k < 3; k++) { if (k == 1) continue; if (k == 2) break; } return k; } default: break; }
  return 9;
}
int find(int v) {
  int i, j;
  for (i = 0; i < 300; i++)
    for (j = 0; j < 300; j++)
      if (i * j == v) goto found;
  return -1;
found:
  return i * 1000 + j;
}
int duff(int n) { int r = 0; switch (n % 4) { case 0: do { r += 1; case 3: r += 10; case 2: r += 100; case 1: r += 1000; } while ((n -= 4) > 0); } return r; }
int main()
{
  int i = 0, n = 0; unsigned k; unsigned char b; short s;
again:
  i++;
  if (i < 5) goto again;
  printf("%d\n", i);
  printf("%d %d %d %d\n", step(1), step(70000), step(-1), step(8));
  printf("%d\n", find(50000));
  printf("%d\n", duff(11));
  while (1) { if (++n > 40000) break; if (n % 2) continue; state += 2; }
  printf("%d %d\n", n, state);
  do { n -= 3; } while (n > 0);
  printf("%d\n", n);
  for (k = 10; k-- > 0;) n += k;
  printf("%d %u\n", n, k);
  for (b = 250; b >= 250; b++) n++;
  printf("%d\n", n);
  for (s = 32766; s > 0; s++) n++;
  printf("%d %d\n", n, s);
  for (i = 0, n = 10; i < n; i++, n--);
  printf("%d %d\n", i, n);
  for (;;) { if (i++ > 8) break; switch (i) { case 7: continue; case 8: n = 100; break; } n++; }
  printf("%d %d\n", i, n);
  if (i == 10 && (n = 70000) && !state - 1 || 0) printf("%d\n", n);
  n = i > 5 ? i < 8 ? 1 : 2 : 3; printf("%d\n", n);
  { int x = 5; { int x = 70000; n = x; } n += x; } printf("%d\n", n);
  return 0;
}
