#define LED PB5
#define KEY (1 << PD2)
#define LIGHTS PORTB

void setup() {
  pinMode(13, OUTPUT);
  pinMode(2, INPUT_PULLUP);
}

void loop() {
  if (digitalRead(2)) digitalWrite(13, HIGH);
  else digitalWrite(13, LOW);
}
