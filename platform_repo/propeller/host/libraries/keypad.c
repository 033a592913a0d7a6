/* keypad.h: each row is driven high in turn while the columns are read; they lose their charge by being driven low between.
 * Source: libkeypad (keypad.c, getNumber.c). */
#include "keypad.h"

static int rows, columns, *row_pins, *column_pins, *values, end_key;

void keypad_setup(int rowCount, int columnCount, int *rowPinCons, int *columnPinCons, int *buttonValues) {
  rows = rowCount, columns = columnCount;
  row_pins = rowPinCons, column_pins = columnPinCons, values = buttonValues;
  for (int row = 0; row < rows; row++) input(row_pins[row]);
  for (int column = 0; column < columns; column++) input(column_pins[column]);
}

/* The first key that is held after a given one (-1: of all). The row of the given key is looked at from its column on only until the
 * first column was tried; then, as in the library, the columns of later rows begin at 0. */
int keypad_readFrom(int button) {
  int first = 0, found = -1;
  if (button != -1) {
    while (first < rows * columns && values[first] != button) first++;
    if (first < rows * columns) first++;
    if (first == rows * columns) return -1;
  }
  int from = first % columns;
  for (int column = 0; column < columns; column++) low(column_pins[column]);
  for (int row = 0; row < rows; row++) input(row_pins[row]);
  for (int row = first / columns; row < rows && found < 0; row++) {
    for (int column = from; column < columns && found < 0; column++) {
      high(row_pins[row]);
      if (input(column_pins[column])) found = row * columns + column;
      low(column_pins[column]);
      from = 0;
    }
    input(row_pins[row]);
  }
  return found < 0 ? -1 : values[found];
}

int keypad_read(void) { return keypad_readFrom(-1); }

/* Digits are put together and printed until a key with another value ends the number. */
int keypad_getNumber(void) {
  int number = 0;
  end_key = -1;
  while (end_key <= 9) {
    int key = keypad_read();
    if (key >= 0 && key <= 9) {
      number = number * 10 + key;
      print("%d", key);
    } else if (key > 9) {
      print(" %c ", key);
      end_key = key;
    }
    while (key != -1) key = keypad_read();
  }
  return number;
}

int keypad_getNumberEndKey(void) { return end_key; }
