// ports 4 5 6 8 9
#include "simpletools.h"
int number = 4;
struct Lamp {
  int pin = 5;
  void set(int to) { pin = to; }
  void on() { DIRA |= 1 << pin; }
} lamp;

int &referred() { return number; }
void change(int &what) { what = 9; }

int main() {
  change(number);
  referred() = 8;
  OUTA |= 1 << number;
  lamp.on();
  lamp.set(6);
}
