// An ultrasonic sensor closes a gate when something is nearer than 20 cm.
#define TRIG 7
#define ECHO 8
#define GATE 13

void setup() {
  pinMode(TRIG, OUTPUT);
  pinMode(ECHO, INPUT);
  pinMode(GATE, OUTPUT);
}

void loop() {
  digitalWrite(TRIG, LOW);
  delayMicroseconds(2);
  digitalWrite(TRIG, HIGH);
  delayMicroseconds(10);
  digitalWrite(TRIG, LOW);
  unsigned long us = pulseIn(ECHO, HIGH, 20000);
  digitalWrite(GATE, us > 0 && us < 1160);
  delay(20);
}
