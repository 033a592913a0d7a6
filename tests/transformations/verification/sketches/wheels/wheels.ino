// Drives a wheel for a second by pulses of 1600 us, and counts the changes of its encoder.
volatile unsigned int ticks;
ISR(PCINT1_vect) { ticks++; }

void setup() {
  Serial.begin(115200);
  pinMode(9, OUTPUT);
  pinMode(A0, INPUT);
  PCMSK1 |= 1;
  PCICR |= 2;
  for (byte pulse = 0; pulse < 50; pulse++) {
    digitalWrite(9, HIGH);
    delayMicroseconds(1600);
    digitalWrite(9, LOW);
    delayMicroseconds(10000);
    delayMicroseconds(8400);
  }
  delay(200);
  Serial.println(ticks);
}

void loop() {}
