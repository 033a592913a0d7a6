// bytes: 2 + 4
#include "simpletools.h"
#include "fdserial.h"
#include "servo.h"

fdserial *link;

int main() {
  int angle = 0;
  link = fdserial_open(9, 8, 0, 9600);
  while (1) {
    servo_angle(16, angle);
    angle = fdserial_rxChar(link) * 10;
    dprint(link, "angle %d\n", angle);
  }
}
