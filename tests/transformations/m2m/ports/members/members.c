#include "simpletools.h"
#include "servo.h"

typedef struct { const char *name; int pin; } Lamp;
struct joint { int pin; int angle; };
struct { int pin; } bell = {7};  // => struct { int pin; } bell = {7};
struct { int pin; } horn = {8};  // => struct { int pin; } horn = {8};
typedef struct { struct { int pin; } eye; struct joint *joints; } Robot;
Lamp lamps[] = {{"red", 5}, {"green", 6}};
struct joint arm[2] = {{16, 900}, {17, 450}};  // => struct joint arm[2] = {{16, 900}, {17, 450}};
Robot robot = {{9}, arm};

void shine(Lamp *lamp) { high(lamp->pin); }  // => void shine(Lamp *lamp) { high(port(lamp->pin)); }
void turn(struct joint *joint) { servo_angle((joint++)->pin, joint->angle); }

int main() {
  int i;
  for (i = 0; i < 2; i++) shine(&lamps[i]);
  turn(robot.joints);
  toggle(bell.pin);  // => toggle(port(bell.pin));
  freqout(horn.pin, 10, 1000);
  set_output((*&robot).eye.pin, 1);
}
