int lampOn(int pin);
