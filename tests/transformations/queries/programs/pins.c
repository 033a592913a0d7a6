#include "simpletools.h"
#include "abdrive.h"
#include "keypad.h"
#define LEFT 5
#define RIGHT (LEFT + 1)
enum { EYE = 9, EAR };
const int speaker = 4;
int rows[4] = { 20, 21, 22, 23 };
int cols[2] = { 24, 25 };
int keys[8];
int lamp = 26;
int changing = 3;

void beep(int p) { freqout(p, 10, 3000); }
void nobody(int p) { low(p); }
void each(int pins[], int n) { for (int i = 0; i < n; i++) high(pins[i]); }

int main()
{
  int i, once;
  once = 11;
  high(26);
  high((17));
  low(lamp);
  input(EAR);
  beep(4);
  beep(LEFT);
  beep(speaker);
  for (i = 16; i <= 18; i++) toggle(i);
  set_outputs(3, 1, 0b111);
  high(rows[1]);
  low(rows[i]);
  changing = 7;
  input(changing);
  get_state(once + 1);
  keypad_setup(4, 2, rows, cols, keys);
  each(cols, 2);
  set_direction(RIGHT, 1);
  fdserial_open(12, 12, 0, 9600);
  high(-1);
  drive_speed(10, 10);
  drive_speed(0, 0);
}
