// Arrays are sent and stored as bytes.
#include <EEPROM.h>
typedef struct { byte kind; int x; } Point;
int values[4];
int rows[2][3];
int kept[3];
int shown[2];
double gains[2];
Point points[2];
int last[2];
char name[8];

void show(int *first) {
  Serial.println(first[0]);
  Serial.write((byte *)first, 4);
}

void send(Point *point) {
  Serial.write((byte *)point, 3);
}

void setup() {
  Serial.begin(9600);
  EEPROM.get(0, kept);
  kept[0]++;
  EEPROM.put(0, kept);
  EEPROM.put(6, shown);
  show(shown);
}

void loop() {
  Serial.write((byte *)values, 8);
  Serial.write((byte *)rows[1], sizeof(rows[1]));
  Serial.write((const uint8_t *)gains, sizeof(gains));
  Serial.write((byte *)points, sizeof(points));
  Serial.write((byte *)&last, sizeof(last));
  Serial.write((byte *)name, sizeof(name));
  send(&points[1]);
  int size = sizeof(Point);
  Serial.println(size);
}
