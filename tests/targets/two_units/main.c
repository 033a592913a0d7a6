#include "simpletools.h"
#include "servo.h"
#include "ping.h"

void turn(int by);

int main() {
  servo_angle(5, 900);
  while (1) {
    print("%d\n", ping_cm(8));
    turn(12);
    freqout(4, 10, 3000);
  }
}
