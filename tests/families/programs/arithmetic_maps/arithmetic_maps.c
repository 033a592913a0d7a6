/* Numbers moved from one range to another, and held in one. */
#include "simpletools.h"

int main() {
  print("%d %d %d ", mapInt(-7, 0, 9, 0, 100), mapInt(5, 10, 0, 0, 100), mapInt(3, 0, 8, 100, 0));
  print("%d\n", mapInt(30000, 0, 65535, 0, 20000));
  print("%.2f %.3f\n", mapFloat(2.5, 0, 10, -1, 1), mapFloat(30, 0, 90, 0, 1));
  print("%d %d %d\n", constrainInt(70000, 10, 40000), constrainInt(-5, 8, -2), constrainInt(-1, 8, -2));
  print("%.1f %.1f\n", constrainFloat(0.5, 3.0, 1.5), constrainFloat(2.25, 3.0, 1.5));
  int word = 0x12345678, turned;
  short half = 0x0102, halfTurned;
  endianSwap(&turned, &word, sizeof(int));
  endianSwap(&halfTurned, &half, 2);
  print("%x %x\n", turned, halfTurned);
  unsigned char four[sizeof(int)];
  endianSwap(four, &word, 4);
  print("%d %d\n", four[0], four[3]);
}
