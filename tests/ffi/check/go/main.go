// What tests/ffi/test.py asks of bindings/go: check MISTAKE. (Layouts are the C compiler's, which reads the header.)
package main

import (
	"errors"
	"log"
	"math"
	"os"
	"reflect"
	"runtime"
	"sync"
	"time"

	"umbilic"
)

// A tetrahedron.
func indices() []uint32 { return []uint32{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2} }

func positions() [][3]float64 { return [][3]float64{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}} }

func notANumber() [][3]float64 {
	wrong := positions()
	wrong[2][1] = math.NaN()
	return wrong
}

func topology(indices, offsets []uint32, vertexCount int, threads uint32) *umbilic.Topology {
	mesh, err := umbilic.NewTopology(indices, offsets, vertexCount, threads)
	if err != nil {
		log.Fatal(err)
	}
	return mesh
}

func tetrahedron() *umbilic.Topology { return topology(indices(), nil, 4, umbilic.AllThreads) }

func closed() *umbilic.Topology {
	mesh := tetrahedron()
	mesh.Close()
	return mesh
}

func normals(mesh *umbilic.Topology, positions [][3]float64, threads uint32) *umbilic.Normals {
	normals, err := mesh.VertexNormals(positions, threads)
	if err != nil {
		log.Fatal(err)
	}
	return normals
}

func curvatures(mesh *umbilic.Topology, positions [][3]float64, threads uint32) *umbilic.Curvatures {
	curvatures, err := mesh.Curvatures(positions, threads)
	if err != nil {
		log.Fatal(err)
	}
	return curvatures
}

func check(good bool) {
	if !good {
		log.Fatal("not as expected")
	}
}

var actions = map[string]func(){
	"index": func() {
		wrong := indices()
		wrong[4] = 4
		topology(wrong, nil, 4, 0)
	},
	"offsets":           func() { topology(indices(), []uint32{0, 3, 2, 9, 12}, 4, 0) },
	"no-offsets":        func() { topology(indices(), []uint32{}, 4, 0) },
	"indices-size":      func() { topology(indices()[:11], nil, 4, 0) },
	"count":             func() { topology(indices(), nil, -1, 0) },
	"positions-size":    func() { normals(tetrahedron(), positions()[:3], 0) },
	"missing":           func() { curvatures(tetrahedron(), nil, 0) },
	"nan-normals":       func() { normals(tetrahedron(), notANumber(), 0) },
	"nan-curvatures":    func() { curvatures(tetrahedron(), notANumber(), 0) },
	"closed-normals":    func() { normals(closed(), positions(), 0) },
	"closed-curvatures": func() { curvatures(closed(), positions(), 0) },
	"twice":             func() { closed().Close() },
	"empty": func() {
		mesh := topology(nil, nil, 0, 0)
		check(len(normals(mesh, nil, 0).Normal) == 0 && len(curvatures(mesh, nil, 0).K1) == 0)
		mesh.Close()
	},
	"threads": func() {
		one, three := topology(indices(), nil, 4, 1), topology(indices(), nil, 4, 3)
		check(reflect.DeepEqual(normals(one, positions(), 1), normals(three, positions(), 3)))
		check(reflect.DeepEqual(curvatures(one, positions(), 1), curvatures(three, positions(), 3)))
		one.Close()
		three.Close()
	},
	// Slices of a value that has pointers as well: cgo takes no such value, but may be told of the numbers alone.
	"inside": func() {
		inside := &struct {
			name      *string
			indices   [12]uint32
			offsets   [5]uint32
			positions [4][3]float64
		}{name: new(string), offsets: [5]uint32{0, 3, 6, 9, 12}}
		copy(inside.indices[:], indices())
		copy(inside.positions[:], positions())
		mesh := topology(inside.indices[:], inside.offsets[:], 4, 0)
		check(reflect.DeepEqual(normals(mesh, inside.positions[:], 0), normals(mesh, positions(), 0)))
		check(reflect.DeepEqual(curvatures(mesh, inside.positions[:], 0), curvatures(mesh, positions(), 0)))
		mesh.Close()
	},
	"forgotten": func() {
		for i := 0; i < 10; i++ {
			tetrahedron()
		}
		for i := 0; i < 10; i++ {
			runtime.GC()
			time.Sleep(10 * time.Millisecond) // finalizers run in a goroutine of their own
		}
	},
	// Eight goroutines use a topology while it is closed: each call has its results, or says that it is closed.
	"concurrent": func() {
		for round := 0; round < 50; round++ {
			mesh := tetrahedron()
			var group sync.WaitGroup
			for i := 0; i < 8; i++ {
				group.Add(1)
				go func() {
					defer group.Done()
					found, err := mesh.Curvatures(positions(), 1)
					var refusal *umbilic.Error
					check(err == nil && len(found.K1) == 4 || errors.As(err, &refusal))
				}()
			}
			time.Sleep(500 * time.Microsecond)
			mesh.Close()
			group.Wait()
		}
	},
}

func main() {
	log.SetFlags(0)
	actions[os.Args[1]]()
}
