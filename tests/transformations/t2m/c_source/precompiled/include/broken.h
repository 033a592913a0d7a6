int half(int pin
