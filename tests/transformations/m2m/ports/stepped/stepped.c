/* A name that is stepped before it is used goes one step beyond what it is compared with. */
#include "simpletools.h"

int at = 2;

void off(int pin)
{
  low(pin); // => low(port(pin));
}

void all_at_once(void)
{
  int lamp = 4;
  do {
    lamp += 1;
    high(lamp); // => high(port(lamp));
  } while (lamp < 6);
}

void next(void)
{
  high(at);
  if (at < 3) at++;
}

int main(void)
{
  int row = 8, column = 12, cell = 20, last = 27;
  again:
  high(++row); // => high(port(++row));
  if (row <= 9) goto again;
  while (column < 14) {
    off(column);
    column++;
  }
  while (1) {
    next();
    all_at_once();
    toggle(cell); // => toggle(port(cell));
    if (++cell > 21) cell = 20;
    if (input(30) && last > 25) last--;
    high(last);
  }
}
