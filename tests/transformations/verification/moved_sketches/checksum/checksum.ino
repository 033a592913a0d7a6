// A checksum of 16 bits over a message, shown by lamps and in the console.
byte message[] = {0x12, 0xF3, 0x77, 0x08, 0xAC};

unsigned int checksum(const byte *data, int length) {
  unsigned int crc = 0xFFFF;
  for (int i = 0; i < length; i++) {
    crc ^= (unsigned int)data[i] << 8;
    for (byte bit = 0; bit < 8; bit++) {
      if (crc & 0x8000) crc = (crc << 1) ^ 0x1021;
      else crc <<= 1;
    }
  }
  return crc;
}

void setup() {
  Serial.begin(9600);
  pinMode(3, OUTPUT);
}

void loop() {
  unsigned int crc = checksum(message, sizeof(message));
  digitalWrite(3, crc < 0x8000);
  Serial.println(crc, HEX);
  message[0]++;
  delay(100);
}
