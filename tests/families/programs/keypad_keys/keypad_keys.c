/* A keypad of three rows whose keys are told once each. */
#include "simpletools.h"
#include "keypad.h"

int rows[3] = {7, 6, 5};
int columns[3] = {4, 3, 2};
int keys[9] = {1, 2, 3, 4, 5, 6, '*', 0, '#'};

int main() {
  int last = -1;
  keypad_setup(3, 3, rows, columns, keys);
  while (1) {
    int key = keypad_read();
    if (key != last) {
      if (key > 9) print("%c\n", key);
      else print("%d\n", key);
      last = key;
    }
    pause(10);
  }
}
