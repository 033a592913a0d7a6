byte mask = 1;
byte low = 3;

void setup() {
  DDRD = 0xFF;
}

void loop() {
  PORTD = mask;
  PORTB |= low;
  mask <<= 1;
  if (mask == 0) mask = 1;
  delay(100);
}

void change() {
  low++;
}
