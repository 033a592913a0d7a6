byte mask = 1;
byte low = 3;

void setup() {
  pinMode(0, OUTPUT), pinMode(1, OUTPUT), pinMode(2, OUTPUT), pinMode(3, OUTPUT), pinMode(4, OUTPUT), pinMode(5, OUTPUT), pinMode(6, OUTPUT), pinMode(7, OUTPUT);
}

void loop() {
  digitalWrite(0, (mask) >> 0 & 1), digitalWrite(1, (mask) >> 1 & 1), digitalWrite(2, (mask) >> 2 & 1), digitalWrite(3, (mask) >> 3 & 1), digitalWrite(4, (mask) >> 4 & 1), digitalWrite(5, (mask) >> 5 & 1), digitalWrite(6, (mask) >> 6 & 1), digitalWrite(7, (mask) >> 7 & 1);
  PORTB |= low;
  mask <<= 1;
  if (mask == 0) mask = 1;
  delay(100);
}

void change() {
  low++;
}
