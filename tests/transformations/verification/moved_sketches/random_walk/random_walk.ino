// Its own random numbers with 16 bits choose how long a lamp is lit.
unsigned int seed = 1;

unsigned int next() {
  seed = seed * 25173 + 13849;
  return seed;
}

void setup() {
  pinMode(11, OUTPUT);
}

void loop() {
  unsigned int n = next();
  digitalWrite(11, n > 30000);
  delay(5 + n / 4096);
}
