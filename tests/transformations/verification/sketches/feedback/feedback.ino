// Turns a servo for half a second by pulses of 1540 us, and tells how many thousandths of a cycle its signal is high before and after.
void tell() {
  unsigned long high = pulseIn(2, HIGH), low = pulseIn(2, LOW);
  Serial.println(high * 1000 / (high + low));
}

void setup() {
  Serial.begin(115200);
  pinMode(9, OUTPUT);
  tell();
  for (byte pulse = 0; pulse < 25; pulse++) {
    digitalWrite(9, HIGH);
    delayMicroseconds(1540);
    digitalWrite(9, LOW);
    delayMicroseconds(10000);
    delayMicroseconds(8460);
  }
  delay(100);
  tell();
}

void loop() {}
