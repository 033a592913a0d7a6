const float STEPS = 100.0;
double total = 0;
char text[16];

void setup() {
  Serial.begin(9600);
  randomSeed(42);
  randomSeed(analogRead(A0));
}

void loop() {
  int reading = analogRead(A1);
  Serial.println((int)(reading * STEPS));
  int steps = reading * STEPS;
  int volts = reading * 5.0 / 1023.0;
  long far = reading * STEPS;
  Serial.println(steps);
  Serial.println(int(reading / 0.01));
  Serial.println(volts);
  Serial.println(far);
  total = total + 0.1;
  Serial.println(total, 9);
  Serial.println(total, 6);
  Serial.println(1.0 / 3.0, 12);
  Serial.println(String(total, 10));
  Serial.println(reading, 10);
  Serial.println(dtostrf(total, 12, 8, text));
  delay(random(100));
}
