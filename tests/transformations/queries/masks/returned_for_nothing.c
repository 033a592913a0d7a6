// ports 6 7
#include <propeller.h>
int turn(int pin, int on) {
  OUTA = on << pin;
  return (OUTA);
}
int main(void) {
  const int pins[2] = {6, 7};
  while (1) for (int i = 0; i < 2; i++) turn(pins[i], 1);
}
