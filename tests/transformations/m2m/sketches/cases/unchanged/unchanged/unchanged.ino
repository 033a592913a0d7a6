int count = 0, step = 1, readings[10], at;
unsigned int half;
long sum;
const int limit = 300;

void setup() {
  for (int i = 0; i < limit; i++) half = i / 2;
}

void loop() {
  int value = analogRead(A0);
  readings[at] = value;
  at = (at + 1) % 10;
  sum = 0;
  for (int i = 0; i < 10; i++) sum += readings[i];
  int average = sum / 10;
  int total = 0;
  for (int i = 0; i < 10; i++) total += readings[i];
  count++;
  if (count >= 8) count = 0;
  int percent = map(value, 0, 1023, 0, 100);
  int around = constrain(value + 20, 0, 1023);
  if (percent + around + average + total / 10 > limit && count < 5) step = -step;
}
