#include "simpletools.h"
#include "keypad.h"

int rows[4] = {0, 1, 2, 3};  // => int rows[4] = {2, 3, 4, 5};
int columns[3] = {4, 5, 6};  // => int columns[3] = {6, 7, 255 /* P6 is not wired yet */};
int keys[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0, 11};  // => int keys[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0, 11};

int main() {
  keypad_setup(4, 3, rows, columns, keys);  // => keypad_setup(4, 3, rows, columns, keys);
  while (1) {
    print("%d\n", keypad_read());
  }
}
