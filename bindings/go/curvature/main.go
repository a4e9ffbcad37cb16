// Vertex normals and curvatures of a mesh with umbilic.
//
//	curvature MESH.off RESULTS    writes them as doubles, statuses as bytes, one array after the other
//	curvature --time MESH.off     prints how long each call takes, in milliseconds, on one thread
package main

import (
	"bufio"
	"encoding/binary"
	"fmt"
	"io"
	"log"
	"math"
	"os"
	"strconv"
	"strings"
	"time"

	"umbilic"
)

// reader hands out the lines of an OFF file that say something, as words, and keeps the first error.
type reader struct {
	lines *bufio.Scanner
	err   error
}

func (r *reader) line() []string {
	for r.err == nil && r.lines.Scan() {
		text, _, _ := strings.Cut(r.lines.Text(), "#")
		if words := strings.Fields(text); len(words) > 0 {
			return words
		}
	}
	if r.err == nil {
		r.err = r.lines.Err()
	}
	if r.err == nil {
		r.err = io.ErrUnexpectedEOF
	}
	return nil
}

func (r *reader) count(words []string, place int) int {
	if r.err == nil && place >= len(words) {
		r.err = io.ErrUnexpectedEOF
	}
	if r.err != nil {
		return 0
	}
	var value uint64
	value, r.err = strconv.ParseUint(words[place], 10, 31)
	return int(value)
}

func (r *reader) number(words []string, place int) float64 {
	if r.err == nil && place >= len(words) {
		r.err = io.ErrUnexpectedEOF
	}
	if r.err != nil {
		return 0
	}
	var value float64
	value, r.err = strconv.ParseFloat(words[place], 64)
	return value
}

func readOff(path string) (positions [][3]float64, indices, offsets []uint32, err error) {
	file, err := os.Open(path)
	if err != nil {
		return nil, nil, nil, err
	}
	defer file.Close()
	r := &reader{lines: bufio.NewScanner(file)}
	r.lines.Buffer(nil, math.MaxInt) // a polygon's line may be long
	counts := r.line()
	if r.err == nil && counts[0] != "OFF" {
		return nil, nil, nil, fmt.Errorf("%s: no OFF file", path)
	}
	if len(counts) == 1 {
		counts = append(counts, r.line()...)
	}
	vertexCount, faceCount := r.count(counts, 1), r.count(counts, 2)
	for vertex := 0; vertex < vertexCount && r.err == nil; vertex++ {
		words := r.line()
		positions = append(positions, [3]float64{r.number(words, 0), r.number(words, 1), r.number(words, 2)})
	}
	offsets = append(offsets, 0)
	for face := 0; face < faceCount && r.err == nil; face++ {
		words := r.line()
		corners := r.count(words, 0)
		for corner := 1; corner <= corners && r.err == nil; corner++ {
			indices = append(indices, uint32(r.count(words, corner)))
		}
		offsets = append(offsets, uint32(len(indices)))
	}
	return positions, indices, offsets, r.err
}

func write(path string, arrays ...any) error {
	file, err := os.Create(path)
	if err != nil {
		return err
	}
	for _, array := range arrays {
		if err := binary.Write(file, binary.LittleEndian, array); err != nil {
			return err
		}
	}
	return file.Close()
}

func times(path string) error {
	positions, indices, offsets, err := readOff(path)
	if err != nil {
		return err
	}
	for round := 0; round < 20; round++ {
		start := time.Now()
		mesh, err := umbilic.NewTopology(indices, offsets, len(positions), 1)
		if err != nil {
			return err
		}
		built := time.Now()
		if _, err := mesh.VertexNormals(positions, 1); err != nil {
			return err
		}
		shaded := time.Now()
		if _, err := mesh.Curvatures(positions, 1); err != nil {
			return err
		}
		done := time.Now()
		fmt.Printf("%.6f\t%.6f\t%.6f\n", milliseconds(built.Sub(start)), milliseconds(shaded.Sub(built)), milliseconds(done.Sub(shaded)))
		mesh.Close()
	}
	return nil
}

func milliseconds(duration time.Duration) float64 { return float64(duration.Nanoseconds()) * 1e-6 }

func curvature(path, results string) error {
	positions, indices, offsets, err := readOff(path)
	if err != nil {
		return err
	}
	// begin: user code
	mesh, err := umbilic.NewTopology(indices, offsets, len(positions), umbilic.AllThreads)
	if err != nil {
		return err
	}
	defer mesh.Close()
	normals, err := mesh.VertexNormals(positions, umbilic.AllThreads)
	if err != nil {
		return err
	}
	found, err := mesh.Curvatures(positions, umbilic.AllThreads)
	if err != nil {
		return err
	}
	// end: user code
	return write(results, normals.Normal, normals.Status, found.K1, found.K2, found.Direction1, found.Direction2, found.Mean,
		found.Gaussian, found.Status)
}

func main() {
	log.SetFlags(0)
	if len(os.Args) != 3 {
		log.Fatal("usage: curvature MESH.off RESULTS | --time MESH.off")
	}
	work := func() error { return curvature(os.Args[1], os.Args[2]) }
	if os.Args[1] == "--time" {
		work = func() error { return times(os.Args[2]) }
	}
	if err := work(); err != nil {
		log.Fatal(err)
	}
}
