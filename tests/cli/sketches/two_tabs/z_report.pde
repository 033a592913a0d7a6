void report(unsigned int value) { Serial.println(value + LED); }
