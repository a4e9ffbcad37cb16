// Package umbilic computes vertex normals and curvatures of polygon meshes. See include/umbilic.h for what everything means.
//
//	mesh, err := umbilic.NewTopology(indices, nil, vertexCount, umbilic.AllThreads) // triangles
//	if err != nil { … }
//	defer mesh.Close()
//	found, err := mesh.Curvatures(positions, umbilic.AllThreads)
//
// Slices are read and written where they are, and not kept.
package umbilic

/*
#cgo CFLAGS: -I${SRCDIR}/../../include
#cgo LDFLAGS: -L${SRCDIR}/../../target/release -lumbilic
#include <umbilic.h>

// Pointers to Go's memory may be handed to C, but not structs of Go's that hold such pointers: these are filled here, on C's stack.
// A pointer to numbers may be one into a larger value that has pointers as well; an untyped one may not.

static umb_output output(double *data) {
  umb_output output = {.data = data, .scalar = UMB_SCALAR_F64};
  return output;
}

static umb_status create(const uint32_t *indices, size_t index_count, const uint32_t *offsets, size_t face_count,
                         size_t vertex_count, uint32_t threads, umb_topology **topology, umb_error *error) {
  umb_faces faces = {.indices = indices, .index_count = index_count, .offsets = offsets, .face_count = face_count};
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  options.threads = threads;
  error->struct_size = sizeof *error;
  return umb_topology_create(&faces, vertex_count, &options, topology, error);
}

static umb_status normals(const umb_topology *topology, const double *positions, size_t count, uint32_t threads, double *normal,
                          uint8_t *status, umb_error *error) {
  umb_points points = {.data = positions, .count = count, .scalar = UMB_SCALAR_F64};
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  options.run.threads = threads;
  outputs.normal = output(normal);
  outputs.status.data = status;
  error->struct_size = sizeof *error;
  return umb_vertex_normals(topology, &points, &options, &outputs, error);
}

static umb_status curvatures(const umb_topology *topology, const double *positions, size_t count, uint32_t threads, double *k1,
                             double *k2, double *direction1, double *direction2, double *mean, double *gaussian, uint8_t *status,
                             umb_error *error) {
  umb_points points = {.data = positions, .count = count, .scalar = UMB_SCALAR_F64};
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  options.run.threads = threads;
  outputs.k1 = output(k1);
  outputs.k2 = output(k2);
  outputs.direction1 = output(direction1);
  outputs.direction2 = output(direction2);
  outputs.mean = output(mean);
  outputs.gaussian = output(gaussian);
  outputs.status.data = status;
  error->struct_size = sizeof *error;
  return umb_curvatures(topology, &points, &options, &outputs, error);
}
*/
import "C"

import (
	"fmt"
	"runtime"
	"sync"
	"unsafe"
)

// AllThreads asks for as many threads as pay.
const AllThreads = 0

// Error is what the library refused.
type Error struct {
	Status  int
	Element uint64 // the offending corner, face, vertex or value, if HasElement
	Message string

	HasElement bool
}

func (e *Error) Error() string {
	if e.HasElement {
		return fmt.Sprintf("umbilic: %s (status %d, element %d)", e.Message, e.Status, e.Element)
	}
	return fmt.Sprintf("umbilic: %s (status %d)", e.Message, e.Status)
}

func errorOf(status C.umb_status, failure *C.umb_error) error {
	if status == C.UMB_OK {
		return nil
	}
	return &Error{
		Status:     int(status),
		Element:    uint64(failure.element),
		Message:    C.GoString(&failure.message[0]),
		HasElement: failure.element != C.UMB_NO_ELEMENT,
	}
}

// Topology is the one-rings of a mesh, built once from its faces and used while positions move. It may be used by many goroutines
// at once.
type Topology struct {
	lock   sync.RWMutex // held for reading by calls, so that Close waits for them
	handle *C.umb_topology
}

// NewTopology takes the vertices of all faces, one face after the other, from 0; where each face starts and the last ends, or nil for
// triangles; and a number of threads. Close it when done.
func NewTopology(indices, offsets []uint32, vertexCount int, threads uint32) (*Topology, error) {
	faceCount := 0
	if offsets != nil {
		faceCount = len(offsets) - 1
	}
	var failure C.umb_error
	t := new(Topology)
	status := C.create(first[C.uint32_t](indices), C.size_t(len(indices)), first[C.uint32_t](offsets), C.size_t(faceCount),
		C.size_t(vertexCount), C.uint32_t(threads), &t.handle, &failure)
	if err := errorOf(status, &failure); err != nil {
		return nil, err
	}
	runtime.SetFinalizer(t, (*Topology).Close)
	return t, nil
}

// Close frees the topology, once calls that use it have returned. Calls that follow return an error.
func (t *Topology) Close() error {
	t.lock.Lock()
	defer t.lock.Unlock()
	C.umb_topology_destroy(t.handle)
	t.handle = nil
	runtime.SetFinalizer(t, nil)
	return nil
}

// Normals of vertices.
type Normals struct {
	Normal [][3]float64 // unit vectors
	Status []uint8      // UMB_VERTEX_ bits
}

// VertexNormals computes N_CM.
func (t *Topology) VertexNormals(positions [][3]float64, threads uint32) (*Normals, error) {
	t.lock.RLock()
	defer t.lock.RUnlock()
	count := C.umb_topology_vertex_count(t.handle)
	normals := &Normals{make([][3]float64, count), make([]uint8, count)}
	var failure C.umb_error
	status := C.normals(t.handle, first[C.double](positions), C.size_t(len(positions)), C.uint32_t(threads),
		first[C.double](normals.Normal), first[C.uint8_t](normals.Status), &failure)
	if err := errorOf(status, &failure); err != nil {
		return nil, err
	}
	return normals, nil
}

// Curvatures of vertices.
type Curvatures struct {
	K1, K2, Mean, Gaussian []float64
	Direction1, Direction2 [][3]float64
	Status                 []uint8 // UMB_VERTEX_ bits
}

// Curvatures computes curvatures by adaptive jets.
func (t *Topology) Curvatures(positions [][3]float64, threads uint32) (*Curvatures, error) {
	t.lock.RLock()
	defer t.lock.RUnlock()
	count := C.umb_topology_vertex_count(t.handle)
	found := &Curvatures{
		K1:         make([]float64, count),
		K2:         make([]float64, count),
		Mean:       make([]float64, count),
		Gaussian:   make([]float64, count),
		Direction1: make([][3]float64, count),
		Direction2: make([][3]float64, count),
		Status:     make([]uint8, count),
	}
	var failure C.umb_error
	status := C.curvatures(t.handle, first[C.double](positions), C.size_t(len(positions)), C.uint32_t(threads),
		first[C.double](found.K1), first[C.double](found.K2), first[C.double](found.Direction1), first[C.double](found.Direction2),
		first[C.double](found.Mean), first[C.double](found.Gaussian), first[C.uint8_t](found.Status), &failure)
	if err := errorOf(status, &failure); err != nil {
		return nil, err
	}
	return found, nil
}

// Where C finds a slice; nil for one without elements.
func first[Number, T any](slice []T) *Number {
	if len(slice) == 0 {
		return nil
	}
	return (*Number)(unsafe.Pointer(&slice[0]))
}
