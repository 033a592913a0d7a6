/* The C library's formats, with floats and with numbers of 32 bits. */
#include <stdio.h>
#include <propeller.h>

int main() {
  char text[50];
  int n = sprintf(text, "%5d|%-5d|%+d|%05.1f|%e", -42, 7, 70000, 2.25, 12345.678);
  puts(text);
  printf("%d %ld %lu %X %c%c\n", n, -70000L, 4000000000UL, 48879, 'o', 107);
  putchar('>');
  printf("%-6s|%6s|%.2s|%%\n", "ab", "cd", "efgh");
  snprintf(text, 6, "%d", 123456789);
  printf("%s %g %.3g\n", text, 0.5, 1234.5);
}
