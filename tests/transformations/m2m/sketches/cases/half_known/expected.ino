void setup() {
  pinMode(13, OUTPUT);
  pinMode(4, OUTPUT); /* PORTB */
}
void loop() {
  digitalWrite(13, HIGH); PORTD += 3;
  digitalWrite(13, LOW); digitalWrite(4, HIGH); // PORTC
  if (digitalRead(2)) PORTC = PINC + 1;
  Serial.println("http://"); PORTD += 1; /* PORTB */
  delay(100);
}
