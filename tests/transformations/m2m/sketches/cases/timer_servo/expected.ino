#include <Servo.h>
Servo servo1A;
// A servo at OC1A, driven by timer 1 itself: 50 Hz, 1 to 2 ms.
void setup() {
  pinMode(9, OUTPUT);


  servo1A.attach(9, 200, 3000, 1500);

}

void loop() {
  servo1A.writeMicroseconds(1000);
  delay(100);
  servo1A.writeMicroseconds(2000);
  delay(100);
}
