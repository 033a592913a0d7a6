/* Numbers and texts in the memory that is kept without power. */
#include "simpletools.h"

int main() {
  char name[12];
  ee_putInt(-123456, 32768);
  ee_putByte(200, 32772);
  ee_putFloat32(-2.75, 32773);
  ee_putStr((unsigned char *)"sensor 7", 9, 32895);
  ee_putInt(0x01020304, 32777);
  print("%d %d\n", ee_getInt(32768), ee_getByte(32772));
  print("%.2f %s\n", ee_getFloat32(32773), ee_getStr((unsigned char *)name, 9, 32895));
  print("%d %d %d %d\n", ee_getByte(32777), ee_getByte(32778), ee_getByte(32779), ee_getByte(32780));
  for (int n = 0; n < 3; n++)
    ee_putByte(n * 100, 33000 + n);
  int sum = 0;
  for (int n = 0; n < 3; n++)
    sum += ee_getByte(33000 + n);
  print("%d %x\n", sum, ee_getInt(32767 + 10));
}
