int16_t phase = 0, other = 0;
static volatile unsigned int crc = 0xFFFF;
uint16_t seed = 1;
int16_t total = 0;
const byte data[] = {200, 100, 50};
byte buffer[2];
long scaled, spread;
int level;

void add(byte b) {
  crc ^= b;
  for (int i = 0; i < 8; i++) crc = crc & 1 ? (crc >> 1) ^ 0xA001 : crc >> 1;
}

int next() {
  seed = seed * 25173 + 13849;
  return seed >> 8;
}

int joined() { return (int16_t)((buffer[1] << 8) | buffer[0]); }

void setup() {
  for (int i = 0; i < 3; i++) total += data[i] * 200;
}

void loop() {
  phase += 6000;
  level = analogRead(A0);
  scaled = (int16_t)(level * 100);
  spread = joined() + 1L;
  if ((int16_t)(phase + 100) > 0) add(next());
}
