/* keypad.h of the Simple Libraries: a matrix of contacts. */
#ifndef ROBOSMI_KEYPAD_H
#define ROBOSMI_KEYPAD_H
#include "simpletools.h"
void keypad_setup(int rowCount, int columnCount, int *rowPinCons, int *columnPinCons, int *buttonValues);
int keypad_read(void);
int keypad_getNumber(void);
int keypad_getNumberEndKey(void);
int keypad_readFrom(int button);
#endif
