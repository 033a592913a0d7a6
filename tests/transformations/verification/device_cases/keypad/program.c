/* A keypad of four keys. */
#include "simpletools.h"
#include "keypad.h"

int rows[2] = {4, 5}, columns[2] = {6, 7}, values[4] = {1, 2, 3, 4};

int main() {
  keypad_setup(2, 2, rows, columns, values);
  int before = -1;
  while (1) {
    int key = keypad_read();
    if (key != before) print("key %d\n", key);
    before = key;
    pause(50);
  }
}
