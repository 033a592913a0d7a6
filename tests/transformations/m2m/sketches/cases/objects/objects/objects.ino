struct Sample { byte kind; int value; long at; double mean; };
struct Pair { int a; int b; };
struct Own { byte kind; int value; };
union Both { int whole; byte parts[2]; };
Sample sample;
Pair pair;
Own own;
Both both;
int numbers[4];
int stored;
byte message[20];

void setup() {
  memcpy(message, &pair, sizeof(pair));
  memcpy(&stored, message + sizeof(int), sizeof(int));
  own.value = sizeof(numbers) / sizeof(int);
}

void loop() {
  const byte *bytes = (const byte *)&sample;
  both.whole = bytes[1];
}
