/* Lines that are typed, read as numbers, with letters between them. */
#include "simpletools.h"

int main() {
  int a, b;
  float f;
  char name[20];
  int n = scan("%d%f%x", &a, &f, &b);
  print("%d %d %.2f %d\n", n, a, f, b);
  print("name? ");
  getStr(name, 19);
  a = getDec();
  b = getHex();
  print("%s %d %x %d\n", name, a, b, getBin());
  char c = getChar();
  print("%c%d %.3f\n", c, c, getFloat());
}
