//# header keypad.h
// A matrix of keys. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Interface/libkeypad (keypad.h, keypad.c).

//# helper Keypad
//#   ram: 68
struct Keypad {
  uint8_t rows, columns;
  int32_t pins[16];     // of the rows, then of the columns
  int32_t *values;
};
static Keypad keypad;

//# adapter keypad_setup
//#   for: void keypad_setup(int rowCount, int columnCount, int *rowPinCons, int *columnPinCons, int *buttonValues)
//#   kind: oneToMany
//#   needs: Keypad simpletools.h/input
//#   fidelity: the pins become inputs; pins and values are taken as they are at the call
//#   limit: 8 rows and 8 columns
//#   range: rowCount 1..8: further rows are not read
//#   range: columnCount 1..8: further columns are not read
//#   stack: 19 6
template <class Pin, class Value>
inline void keypad_setup(int32_t rowCount, int32_t columnCount, Pin *rowPinCons, Pin *columnPinCons, Value *buttonValues) {
  keypad.rows = min(rowCount, 8);
  keypad.columns = min(columnCount, 8);
  for (uint8_t row = 0; row < keypad.rows; row++) input(keypad.pins[row] = rowPinCons[row]);
  for (uint8_t column = 0; column < keypad.columns; column++) input(keypad.pins[8 + column] = columnPinCons[column]);
  uint8_t keys = keypad.rows * keypad.columns;
  delete[] keypad.values;
  keypad.values = new int32_t[keys];
  for (uint8_t key = 0; key < keys; key++) keypad.values[key] = buttonValues[key];
}

//# adapter keypad_readFrom
//#   for: int keypad_readFrom(int button)
//#   kind: oneToMany
//#   needs: Keypad simpletools.h/input simpletools.h/high simpletools.h/low
//#   fidelity: the first key held behind that one, -1 without one; in the first row looked at, columns behind it only, as there
//#   stack: 0
inline int32_t keypad_readFrom(int32_t button) {
  uint8_t keys = keypad.rows * keypad.columns, key = 0;
  if (button != -1) {
    while (key < keys && keypad.values[key] != button) key++;
    key += key < keys;
  }
  if (key == keys) return -1;
  for (uint8_t column = 0; column < keypad.columns; column++) low(keypad.pins[8 + column]);
  for (uint8_t row = 0; row < keypad.rows; row++) input(keypad.pins[row]);
  for (bool held = false; key < keys && !held;) {
    int32_t row = keypad.pins[key / keypad.columns];
    do {
      int32_t column = keypad.pins[8 + key % keypad.columns];
      high(row);
      held = input(column);
      low(column);
      if (held) break;
    } while (++key % keypad.columns);
    input(row);
  }
  return key < keys ? keypad.values[key] : -1;
}

//# adapter keypad_read
//#   for: int keypad_read(void)
//#   kind: oneToOne
//#   needs: keypad_readFrom
//#   fidelity: the first key held, -1 without one
//#   stack: 0
inline int32_t keypad_read() {
  return keypad_readFrom(-1);
}

//# helper keypad_end_key
//#   ram: 4
static int32_t keypad_end_key;

//# adapter keypad_getNumber
//#   for: int keypad_getNumber(void)
//#   kind: oneToMany
//#   needs: keypad_end_key keypad_read simpletext.h/putChar simpletext.h/putDec
//#   fidelity: the digits until a key above 9 is held and let go; it prints the keys, as there
//#   stack: 82 68
//#   interrupt: USART_RX_vect 10
//#   interrupt: USART_UDRE_vect 19
inline int32_t keypad_getNumber() {
  int32_t number = 0;
  keypad_end_key = -1;
  while (keypad_end_key <= 9) {
    int32_t key = keypad_read();
    if (key >= 0 && key <= 9) {
      number = number * 10 + key;
      putDec(key);
    } else if (key > 9) {
      putChar(' ');
      putChar(key);
      putChar(' ');
      keypad_end_key = key;
    }
    for (; key != -1; key = keypad_read()) yield();
    yield();
  }
  return number;
}

//# adapter keypad_getNumberEndKey
//#   for: int keypad_getNumberEndKey(void)
//#   kind: oneToOne
//#   needs: keypad_end_key
//#   fidelity: exact: the key that ended the last number
//#   stack: 0
inline int32_t keypad_getNumberEndKey() {
  return keypad_end_key;
}
