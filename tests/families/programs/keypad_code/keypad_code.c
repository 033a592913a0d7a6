/* A code that is typed on a keypad opens a lock. */
#include "simpletools.h"
#include "keypad.h"

int rowPins[] = {10, 11}, columnPins[] = {12, 13, 14};
int values[] = {1, 2, 3, 'A', 'B', 'C'};

int main() {
  keypad_setup(2, 3, rowPins, columnPins, values);
  low(26);
  int code = keypad_getNumber();
  print("%d %c\n", code, keypad_getNumberEndKey());
  if (code == 312) high(26);
  pause(100);
  print("%d %d\n", keypad_readFrom(-1), keypad_readFrom(1));
}
