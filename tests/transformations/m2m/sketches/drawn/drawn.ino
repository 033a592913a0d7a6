const int TRIG = 9;
const int ECHO = 10;

void setup() {
  pinMode(TRIG, OUTPUT);
  pinMode(ECHO, INPUT);
}

void loop() {
  digitalWrite(TRIG, HIGH);
  digitalWrite(TRIG, LOW);
  delay(pulseIn(ECHO, HIGH) / 58);
}
