/* What is passed to functions that take more than they name, and what they are told about it. */
#include <stdio.h>
#include <stdlib.h>
#include <stdarg.h>

char line[40];
int list[3] = { 70000, -5, 70001 };  // compared as 32 bits

void note(char *format, ...) {
  va_list values;
  va_start(values, format);
  vsprintf(line, format, values);  /* hands its format on */
  va_end(values);
}

int compare(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

int main(void);

int main(void) {
  int x = 70000, *p = &x;
  short s = 4;
  char c = 200;
  note("%d %x" " %c%%", x, s, c);
  qsort(list, 3, sizeof(int), compare);
  sum: x += list[1] * s;
  return *p == x;
}
