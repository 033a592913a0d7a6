#include <stdio.h>
#include <string.h>
typedef unsigned char uchar;
#define DISTANCE(a, b) ((a) - (b))
#define END(name) name ## _end
char store[40] = "abcdefghijklmnopqrstuvwxyz";
void *text_end = store + 26;
struct place { void *here; const void *there; };
struct place places[2] = { { store, store }, { store, store } };
volatile struct { uchar serial[3][8]; short t[20]; } sense[2];
const uchar table[2][8] = { { 1, 2 }, { 3, 4 } };
const char *texts[2][2] = { { "one", "two" }, { "three", "four" } };
void *get(int at) { return store + at; }
int sum(int n, uchar rows[][8]) { int s = 0; for (int i = 0; i < n; i++) s += rows[i][0] * 1000 + rows[i][1]; return s; }
int last(uchar (*rows)[8]) { return rows[1][1]; }
char first(const char *names[][2]) { return names[1][0][0]; }
int main() {
  void *p = store, *t;
  const void *q = store;
  int n = 0;
  p++;
  ++p;
  printf("%c", *(char *)p);
  p--;
  p += 3 + n;
  p -= n ? 5 : 1;
  printf("%c", *(char *)p);
  t = p++;
  printf("%c%c", *(char *)t, *(char *)p);
  t = --p;
  printf("%c%c", *(char *)t, *(char *)p++);
  places[1].here += 2;
  places[0].here = places[1].here++;
  places[1].there = ++q;
  printf("%c%c%c\n", *(char *)places[0].here, *(char *)places[1].here, *(const char *)places[1].there);
  while (q++ < text_end) n++;
  printf("%d %d %d %d\n", n, (int)DISTANCE(p, get(1)), (int)(END(text) - p), (int)(q - places[0].there));
  printf("%d %d %c\n", (int)sizeof(void), (int)sizeof(*p), *(char *)(2 + get(3) + 1 - 1));
  for (p = store; p < get(5); p++) putchar(*(char *)p - 32);
  sense[1].serial[0][0] = 40;
  sense[1].serial[2][1] = 7;
  printf("\n%d %d %d %c\n", sum(3, sense[1].serial), sum(2, table), last(table), first(texts));
  return 0;
}
