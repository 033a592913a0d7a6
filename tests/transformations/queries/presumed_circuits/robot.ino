#include <LiquidCrystal.h>
#include <Servo.h>
const int trig = 9, echo = 8;
LiquidCrystal lcd(12, 11, 5, 4, 3, 2);
Servo arm;
void setup() { arm.attach(10); pinMode(trig, OUTPUT); pinMode(echo, INPUT); pinMode(13, OUTPUT); lcd.begin(16, 2); Serial.begin(9600);}
void loop() {
  digitalWrite(trig, HIGH); delayMicroseconds(10); digitalWrite(trig, LOW);
  long d = pulseIn(echo, HIGH) / 58;
  lcd.setCursor(0,0); lcd.print(d);
  arm.write(d > 20 ? 0 : 90);
  digitalWrite(13, d < 20);
  int v = analogRead(A0); Serial.println(v);
  delay(100);
}
