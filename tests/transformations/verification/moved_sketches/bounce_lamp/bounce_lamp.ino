// A light that runs between three lamps; the step is a char that becomes -1.
char place = 0;
char step = 1;
const int lamps[3] = {2, 3, 4};

void setup() {
  for (int i = 0; i < 3; i++) pinMode(lamps[i], OUTPUT);
}

void loop() {
  digitalWrite(lamps[place], HIGH);
  delay(20);
  digitalWrite(lamps[place], LOW);
  if (place + step < 0 || place + step > 2) step = -step;
  place += step;
}
