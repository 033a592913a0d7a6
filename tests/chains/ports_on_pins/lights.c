/* Lights on ports that stand in the text in many ways: each shines once; those that are not wired must move no pin. */

#include "simpletools.h"

#define LAMP 26
#define BLINK(p) do { high(p); pause(1); low(p); } while (0)

const int row[3] = {4, 5, 6};
const int shown = 10;
int filled[2];
struct light { int pin; int on; } pair[2] = {{11, 1}, {12, 1}};
enum { GREEN = 14, YELLOW };

void flash(int pin) { high(pin); pause(1); low(pin); }

int main() {
  int i;
  flash(LAMP);
  BLINK(27);
  for (i = 0; i < 3; i++) flash(row[i]);
  print("P%d\n", shown);
  high(shown);
  pause(1);
  low(shown);
  filled[0] = 8;
  filled[1] = 16;
  for (i = 0; i < 2; i++) BLINK(filled[i]);
  for (i = 0; i < 2; i++) BLINK(pair[i].pin);
  BLINK(i > 1 ? GREEN : YELLOW);
  set_directions(21, 20, 0b11);
  set_outputs(21, 20, 0b11);
  pause(1);
  set_outputs(21, 20, 0b00);
  OUTA |= 1 << 22;
  DIRA |= 1 << 22;
  pause(1);
  OUTA &= ~(1 << 22);
  square_wave(-26, 0, 0);
  return 0;
}
