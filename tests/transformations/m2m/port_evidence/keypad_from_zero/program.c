#include "simpletools.h"
#include "keypad.h"
int rows[2] = {7, 6}, cols[2] = {3, 2}, values[4] = {1, 2, 3, 4};
int main() { keypad_setup(2, 2, rows, cols, values); print("%d", keypad_getNumber()); }
