// A sketch of the user's own, for any board: a button with a pull-up, an interrupt, a servo, and a text that names widths
#include <Arduino.h>
#include <Servo.h>

const int button = 5, lamp = 6, edge = 3, arm = 9;
volatile int edges = 0;
Servo servo;

struct Ready {
  Ready() { pinMode(lamp, OUTPUT); }  // before setup()
} ready;

void count() { edges++; }

void setup() {
  Serial.begin(115200);
  pinMode(button, INPUT_PULLUP);
  attachInterrupt(digitalPinToInterrupt(edge), count, RISING);
  servo.attach(arm);
  servo.writeMicroseconds(1700);
  char sign = (char)200;
  Serial.println(String("widths ") + sizeof(int) + " " + sizeof(double) + " " + sizeof(void *) + " " + (sign < 0 ? "signed" : "unsigned"));
}

void loop() {
  digitalWrite(lamp, digitalRead(button) == LOW ? HIGH : LOW);
  if (edges == 3) {
    Serial.println("three");
    edges = 0;
  }
  delay(10);
}
