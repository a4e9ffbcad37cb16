module check

go 1.19

require umbilic v0.0.0

replace umbilic => ../../../../bindings/go
