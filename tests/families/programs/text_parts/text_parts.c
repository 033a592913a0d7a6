/* Numbers and texts put out one by one, and made in memory. */
#include "simpletools.h"

char made[40];

int main() {
  putDec(-7); putChar(' '); putHex(255); putChar(' '); putBin(10); putStr(" ");
  putBinLen(5, 8); putStr(" "); putDecLen(42, 5); putStr(" "); putHexLen(10, 4);
  putLine("|");
  putFloat(2.5); putStrLen("abc", 6); putStrLen("ab,cd", 4); putln("|");
  int n = sprint(made, "%d,%3d,%.1f,%s", -70000, 5, -0.25, "end");
  print("%s %d %d\n", made, n, strlen(made));
  putStrWithNpcVals("a\tb");
  writeFloatPrecision(simpleterm_pointer(), 12.3456, 8, 2);
  writeHexLen(simpleterm_pointer(), 0xBEEF, 6);
  writeStr(simpleterm_pointer(), "\n");
  dprint(simpleterm_pointer(), "%c%c%c\n", 'o', 'n', 'e');
}
