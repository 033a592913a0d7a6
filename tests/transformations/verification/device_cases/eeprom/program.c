/* The board's own memory: what was stored is there. */
#include "simpletools.h"

int main() {
  ee_putInt(123456, 32768);
  ee_putStr("robot", 6, 32800);
  char name[6];
  print("%d\n", ee_getInt(32768));
  print("%s\n", ee_getStr(name, 6, 32800));
}
