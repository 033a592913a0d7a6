#include "simpletools.h"
#include "servo.h"

int lamp = 3;

int main() {
  servo_angle(5, 900);
  while (1) {
    if (input(7)) high(lamp);
    pause(20);
  }
}
