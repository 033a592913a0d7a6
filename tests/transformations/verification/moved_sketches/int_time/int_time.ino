// A time in 16 bits: differences are right though it starts again.
unsigned int last = 65000u;
byte level = LOW;

void setup() {
  pinMode(9, OUTPUT);
}

void loop() {
  unsigned int now = millis() + 65000u;
  if ((unsigned int)(now - last) >= 40) {
    last = now;
    level = !level;
    digitalWrite(9, level);
  }
}
