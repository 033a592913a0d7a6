#include "Parts.h"
#define EYE 0

Sensor eye(EYE);
Robot* robot;

void setup() {
  robot = new Robot(new Lamp(5), eye);
}

void loop() {
  robot->go();
}
