uint16_t width = 50;
byte small = 5;
unsigned int wide = 100;
int level = 0;
char text[12];
union Packet {
  struct { byte id; int value; } part;
  byte raw[3];
} packet;
union Pair {
  struct { byte low; unsigned char high; };
  uint16_t both;
} pair;
uint16_t near = 436, far = 500;
int side = 200;
enum Limit { NEAR = 1, FAR = 40000 };
int16_t flags = 0;
int16_t farthest = 0;
int bits = 0;
int16_t masked = 0;
int pace = 3;
const auto scale = 300;
class Track {
  int16_t sum = 0;
public:
  void add(int step) { sum += step; }
  unsigned age(unsigned now) const { return (uint16_t)(now - sum); }
};
Track track;

int shortened(long value) { return (int16_t)(value); }

void setup() {
  Serial.begin(9600); while (!Serial && millis() < 3000) {}
}

void loop() {
  level = analogRead(A0) - 600;
  int reading = analogRead(A0);
  uint16_t gap = level - wide;
  if ((uint16_t)(level) < width) Serial.println("below");
  if (reading < width) Serial.println("dark");
  if (level < small) Serial.println("small");
  if ((uint16_t)(level) < gap) Serial.println("gap");
  if (level < wide) Serial.println("wide");
  if ((uint16_t)(level) < (uint16_t)reading) Serial.println("cast");
  Serial.println((uint16_t)(level) / width);
  Serial.println(reading / width);
  long chosen = (uint16_t)(level < 0 ? level : wide);
  long known = reading > 9 ? reading : wide;
  Serial.println(chosen + known);
  text[Serial.readBytesUntil('\n', text, 7)] = 0;
  Serial.println((int16_t)(atoi(text)));
  if ((int16_t)(atoi(text)) > 0) Serial.println("more");
  long typed = (int16_t)(atoi(text));
  Serial.println(typed);
  Serial.println(itoa((uint16_t)(level), text, 16));
  Serial.println(itoa(level, text, 10));
  Serial.println(String((uint16_t)(level), HEX));
  Serial.println(String(level));
  Serial.println(String(reading, BIN));
  Serial.write(packet.raw, sizeof(packet));
  int16_t apart = abs((uint16_t)(near - far));
  if (abs((uint16_t)(near - far)) > 100) Serial.println(apart);
  Serial.println(constrain((uint16_t)(near - far), 0, 100));
  long area = (int16_t)(sq(side));
  Serial.println(area + shortened(70000));
  if ((uint16_t)(level) == 0x8000) Serial.println("least");
  Serial.println((uint16_t)((unsigned)level) / 2);
  track.add(500);
  Serial.println(track.age(5));
  bitWrite(flags, 15, reading > 9);
  if (flags < 0) Serial.println("set");
  bitSet(bits, 14);
  masked &= 0xFFFF;
  farthest = FAR;
  if ((uint16_t)(level) < FAR) Serial.println("far");
  if ((uint16_t)(level) == NEAR) Serial.println("near");
  long most = (uint16_t)(max(level, wide));
  Serial.println(most + min((uint16_t)(level), width));
  Serial.println((uint16_t)(~wide));
  if ((int)wide < level) Serial.println("turned");
  pace += 7;
  if (pace > 400) pace = 3;
  long way = (int16_t)(pace * 200);
  float mean = (int16_t)(pace * 200) / 3;
  long whole = 200L * pace;
  Serial.println((int16_t)(pace * 2) + way + mean + whole);
  Serial.println((int16_t)(scale * 200));
  Serial.println(abs(level));
}
