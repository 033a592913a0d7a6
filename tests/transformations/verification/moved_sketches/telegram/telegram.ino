// A telegram of a struct, sent byte by byte.
struct Telegram {
  byte kind;
  int speed;
  long position;
};

Telegram telegram = {7, -300, 123456L};

void setup() {
  Serial.begin(57600);
}

void loop() {
  Serial.write((byte *)&telegram, sizeof(telegram));
  Serial.println();
  telegram.speed += 25;
  telegram.position -= 1000;
  delay(100);
}
