// Methods of the program with the names of those that they call, in two classes.
#include <Servo.h>

class Leg {
  Servo hip;
  byte pin;
 public:
  void attach(byte first, byte second);
  void set(int value) { hip.write(value); }
};

class Lamp {
 public:
  void attach(byte speed, byte number);
  void set(int number) { digitalWrite(number, HIGH); }
};

Leg leg;
Lamp lamp;

void setup() {
  leg.attach(4, 5);
  lamp.attach(6, 7);
}

void loop() {
  leg.set(30);
  lamp.set(7);
}

void Leg::attach(byte first, byte second) {
  pin = first;
  hip.attach(pin);
  pinMode(second, OUTPUT);
}

void Lamp::attach(byte speed, byte number) {
  Serial.begin(speed * 100L);
  pinMode(number, OUTPUT);
}
