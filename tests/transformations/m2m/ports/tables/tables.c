#include "simpletools.h"
#include "servo.h"

struct joint { int pin; int angle; };
const int servos[] = {12, 13, 14};  // => const int servos[] = {9, 10, 255 /* P14 is not wired */};
struct joint arm[2] = {{16, 900}, {17, 450}};  // => struct joint arm[2] = {{16, 900}, {17, 450}};
int filled[2];  // => int filled[2];
int sparse[4] = {20, 21};  // => int sparse[4] = {20, 21};

int main() {
  int i;
  for (i = 0; i < 3; i++) servo_angle(servos[i], 900);  // => for (i = 0; i < 3; i++) servo_angle(servos[i], 900);
  for (i = 0; i < 2; i++) servo_angle(arm[i].pin, arm[i].angle);  // => for (i = 0; i < 2; i++) servo_angle(port(arm[i].pin), arm[i].angle);
  filled[0] = 5;  // => filled[0] = 5;
  filled[1] = 6;  // => filled[1] = 6;
  high(filled[i - 1]);  // => high(port(filled[i - 1]));
  low(sparse[0]);  // => low(port(sparse[0]));
  low(sparse[i]);  // => low(port(sparse[i]));
}
