#include <stdio.h>
#include <string.h>
#include <stdlib.h>
#define N(a) (sizeof(a) / sizeof((a)[0]))
int squares[300]; short m[3][4] = { { 1, 2, 3, 4 }, { 5 }, { 9, 10, 11, 30000 } };
const int odd[] = { 1, 3, 70001 };
char *names[] = { "north", "east", "south", "west" };
unsigned char data[6] = "ab\xF0";
extern int later[3];
int index_of(const int *list, int n, int v) { int i; for (i = 0; i < n; ++i) if (list[i] == v) return i; return -1; }
void rows_of(short (*rows)[4], int n) { int i, j; for (i = 0; i < n; i++) for (j = 0; j < 4; j++) rows[i][j] += i * 100 + j; }
int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }
int compare_short(const void *a, const void *b) { const short *x = a, *y = b; return *x < *y ? -1 : *x > *y; }
int main()
{
  int i, *p, list[5] = { 70000, -70000, 40000, 5, 65536 }; short few[] = { 5, -300, 30000, 2 };
  char c = 2; unsigned char k = 250; char copy[16]; int *heap;
  for (i = 0; i < 300; i++) squares[i] = i * i;
  printf("%d %d\n", squares[299], squares[250 + c]);
  printf("%d %d\n", m[2][3] + m[2][2] + m[2][3], *(*(m + 1)));
  printf("%d %d\n", (int)N(m), (int)N(names));
  printf("%s %c\n", names[c], *(names[3] + 1));
  printf("%d\n", index_of(odd, N(odd), 70001));
  p = squares + k; p += 30; printf("%d %d\n", *p, (int)(p - squares));
  printf("%d\n", p[-10]);
  printf("%d\n", 3[squares]);
  qsort(list, 5, sizeof(int), compare);
  for (i = 0; i < 5; i++) printf("%d ", list[i]);
  printf("\n");
  qsort(few, N(few), sizeof few[0], compare_short);
  for (i = 0; i < 4; i++) printf("%d ", few[i]);
  printf("\n");
  memset(list, 0xFF, sizeof list); printf("%d\n", list[4]);
  memcpy(copy, names[0], 6); printf("%s\n", copy);
  printf("%d %d\n", data[2] << 4, later[2]);
  heap = malloc(10 * sizeof(int)); for (i = 0; i < 10; i++) heap[i] = i * 10000; printf("%d\n", heap[9]); free(heap);
  heap = calloc(3, sizeof *heap); printf("%d\n", heap[2]); free(heap);
  { int n = 4, v[n]; for (i = 0; i < n; i++) v[i] = i * 20000; printf("%d %d\n", v[3], (int)(sizeof v / sizeof v[0])); }
  for (p = list; p != &list[5]; ) *p++ = 9;
  printf("%d\n", list[0] + list[4]);
  { char *s = "abc"; int h = 0; while (*s) h = h << 8 | *s++; printf("%d\n", h); }
  rows_of(m, 3); printf("%d %d\n", m[1][0], m[2][2]);
  return 0;
}
int later[3] = { 1, 2, 90000 };
