/* What print makes of formats, and of those that it does not know. */
#include "simpletools.h"

int main() {
  int n = print("%5d|%05d|%-5d|%u|", -42, -42, 7, -1);
  print("%d\n", n);
  print("%x %X|%8b|%s|%3s|%c%c|%%|%ld\n", 48879, 5, "ab", "xyz", 65, 'b', 9);
  print("%.2f|%7.1f|%f|%.0f|%3.1f\n", 3.14159, -42.25, 1.5, 2.5, 0.06);
  short small = -3;
  char letter = 200;
  unsigned char byte = 250;
  long big = 3000000000;
  print("%d %d %d %u %x\n", small, letter, byte + 10, big, small);
}
