// ports ? 7
#include "simpletools.h"
int number = 4;
struct Lamp {
  int pin;
  Lamp(int given) : pin(given) {}
  void set(int to) { pin = to; }
  void on() { OUTA |= 1 << pin; }
};
Lamp lamp(7);

void change(int &what) { what = 9; }

int main() {
  lamp.on();
  lamp.set(5);
  change(number);
  high(number + 1);
  low(7);
}
