struct __attribute__((packed)) Sample { byte kind; int16_t value; long at; float mean; };
struct Pair { int16_t a; int16_t b; };
struct Own { byte kind; int value; };
union Both { int16_t whole; byte parts[2]; };
Sample sample;
Pair pair;
Own own;
Both both;
int numbers[4];
int16_t stored;
byte message[20];

void setup() {
  memcpy(message, &pair, sizeof(pair));
  memcpy(&stored, message + sizeof(int16_t), sizeof(int16_t));
  own.value = sizeof(numbers) / sizeof(int);
}

void loop() {
  const byte *bytes = (const byte *)&sample;
  both.whole = bytes[1];
}
