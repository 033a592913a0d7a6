// A servo, two PWM slices, a tone that ends, an input's voltage as PWM.
#include <Servo.h>

Servo servo;

void setup() {
  servo.attach(5, 544, 2400);
  servo.write(0);
  analogWrite(9, 64);
  analogWriteFreq(20000);
  analogWriteRange(1000);
  analogWrite(12, 750);
  tone(7, 440, 100);
  delay(100);
  servo.write(180);
  analogWrite(9, 0);
  analogReadResolution(12);
  pinMode(LED_BUILTIN, OUTPUT);
}

void loop() {
  digitalWrite(LED_BUILTIN, analogRead(A2) > 2048);
}
