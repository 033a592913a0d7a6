// each way in which a sketch writes a pin
#include <LiquidCrystal.h>
#include <Servo.h>
#include <SoftwareSerial.h>
#define BUZZER 8
#define POT A1
const int relay = 7;
const byte motors[] = { 3, 5 };
enum Lamps { RED = 9, GREEN };
LiquidCrystal lcd(12, 11, 6, 4, 2, 13);
SoftwareSerial radio(10, A3);
Servo arm;

void setup() {
  pinMode(relay, OUTPUT);
  for (int i = 0; i < 2; i++) pinMode(motors[i], OUTPUT);
  pinMode(RED, OUTPUT);
  arm.attach(A2);
  tone(BUZZER, 440);
  attachInterrupt(1, onEdge, FALLING);
}

void onEdge() {}

void loop() {
  digitalWrite(GREEN, HIGH);
  digitalWrite(LED_BUILTIN, analogRead(POT) > 512);
  analogWrite(motors[0], analogRead(0) / 4);
}
