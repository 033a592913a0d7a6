// Scans two rows and two columns: a column with its pull-up reads low while its row is driven low and the key is held.
void setup() {
  Serial.begin(115200);
  pinMode(6, INPUT_PULLUP);
  pinMode(7, INPUT_PULLUP);
}

void loop() {
  for (int row = 4; row <= 5; row++) {
    digitalWrite(row, LOW);
    pinMode(row, OUTPUT);
    delay(1);
    for (int column = 6; column <= 7; column++)
      if (!digitalRead(column)) {
        Serial.print(row - 4);
        Serial.print(column - 6);
        Serial.print(' ');
      }
    pinMode(row, INPUT);
  }
  delay(20);
}
