#include "simpletools.h"
#include "keypad.h"

int rows[2] = {7, 6};  // => int rows[2] = {7, 6};
int columns[2] = {3, 2};  // => int columns[2] = {4, 5};
int keys[4] = {1, 2, 3, 4};

int main() {
  int i;
  for (i = 0; i < 2; i++) print("row on P%d\n", rows[i]);  // => for (i = 0; i < 2; i++) print("row on P%d\n", rows[i]);
  keypad_setup(2, 2, rows, columns, keys);  // => keypad_setup(2, 2, ports<1>(rows, 2), columns, keys);
  print("%d\n", keypad_read());
  return 0;  // => return;
}
