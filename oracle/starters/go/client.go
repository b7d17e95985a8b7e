// The line protocol of raycert: reads a case a line, answers each with a line, flushed, in order.
//
// encoding/json reads and writes every double exactly, so numbers are plain decimals. Infinity
// is null.
package main

import (
	"bufio"
	"encoding/json"
	"errors"
	"fmt"
	"io"
	"log"
	"math"
	"os"
)

type Vector [3]float64

// Ray is origin + t direction, t >= 0.
type Ray struct{ Origin, Direction Vector }

// Solid has the fields of its type; the others are zero.
type Solid struct {
	Type          string
	Point, Normal Vector  // half_space: (x - point) . normal <= 0
	Center        Vector  // sphere
	P, Q          Vector  // infinite_cylinder, slab, cylinder
	Radius        float64 // sphere, infinite_cylinder, cylinder
	Of            []Solid // union, intersection, difference: one part or more
}

// Pair is an interval of t. A list is sorted and disjoint; the last Leave may be infinite.
type Pair struct{ Enter, Leave float64 }

// What comes on a line. Pointers tell what is missing or null from a zero.
type number = *float64
type line struct {
	Hello json.RawMessage
	ID    json.RawMessage // given back as it came
	Solid form
	Ray   struct{ Origin, Direction []number }
}
type form struct {
	Type                        *string
	Point, Normal, Center, P, Q []number
	Radius                      number
	Of                          []form
}

type reply struct {
	ID          json.RawMessage `json:"id,omitempty"`
	Intervals   *[][2]number    `json:"intervals,omitempty"`
	Unsupported string          `json:"unsupported,omitempty"`
	Error       string          `json:"error,omitempty"`
}

// unsupported is the type of a solid that this client does not have.
type unsupported string

func (kind unsupported) Error() string { return string(kind) }

func vector(name string, numbers []number) (v Vector, err error) {
	if len(numbers) != 3 {
		return v, fmt.Errorf("%s has not three numbers", name)
	}
	for i, x := range numbers {
		if x == nil {
			return v, fmt.Errorf("%s has a null", name)
		}
		v[i] = *x
	}
	return v, nil
}

func (f form) solid() (s Solid, err error) {
	if f.Type == nil {
		return s, errors.New("a solid has no type")
	}
	s.Type = *f.Type
	var faults [3]error
	switch s.Type {
	case "half_space":
		s.Point, faults[0] = vector("point", f.Point)
		s.Normal, faults[1] = vector("normal", f.Normal)
	case "sphere":
		s.Center, faults[0] = vector("center", f.Center)
	case "infinite_cylinder", "slab", "cylinder":
		s.P, faults[0] = vector("p", f.P)
		s.Q, faults[1] = vector("q", f.Q)
	case "union", "intersection", "difference":
		if len(f.Of) == 0 {
			return s, errors.New("a tree has no parts")
		}
		for _, part := range f.Of {
			child, err := part.solid()
			if err != nil {
				return s, err
			}
			s.Of = append(s.Of, child)
		}
	default:
		return s, unsupported(s.Type)
	}
	switch s.Type {
	case "sphere", "infinite_cylinder", "cylinder":
		if f.Radius == nil {
			faults[2] = errors.New("radius is missing")
		} else {
			s.Radius = *f.Radius
		}
	}
	return s, errors.Join(faults[:]...)
}

func intervals(asked line) (pairs []Pair, err error) {
	defer func() {
		if what := recover(); what != nil { // the next case may be answered
			err = fmt.Errorf("the tracer panicked: %v", what)
		}
	}()
	solid, err := asked.Solid.solid()
	if err != nil {
		return nil, err
	}
	origin, err := vector("origin", asked.Ray.Origin)
	if err != nil {
		return nil, err
	}
	direction, err := vector("direction", asked.Ray.Direction)
	if err != nil {
		return nil, err
	}
	return intersect(solid, Ray{origin, direction}), nil
}

func orNull(t float64) number {
	if math.IsInf(t, 0) {
		return nil
	}
	return &t
}

func answer(text []byte) any {
	var asked line
	if err := json.Unmarshal(text, &asked); err != nil {
		return reply{ID: asked.ID, Error: err.Error()}
	}
	if asked.Hello != nil {
		return hello
	}
	pairs, err := intervals(asked)
	var kind unsupported
	if errors.As(err, &kind) {
		return reply{ID: asked.ID, Unsupported: "solid type " + string(kind)}
	}
	if err != nil {
		return reply{ID: asked.ID, Error: err.Error()}
	}
	list := make([][2]number, len(pairs))
	for i, pair := range pairs {
		list[i] = [2]number{orNull(pair.Enter), orNull(pair.Leave)}
	}
	return reply{ID: asked.ID, Intervals: &list}
}

func main() {
	in := bufio.NewReader(os.Stdin) // not a Scanner, which has a longest line
	out := json.NewEncoder(os.Stdout)
	out.SetEscapeHTML(false)
	for {
		text, err := in.ReadBytes('\n')
		if len(text) > 0 {
			if err := out.Encode(answer(text)); err != nil {
				log.Fatal(err)
			}
		}
		if err == io.EOF {
			return
		}
		if err != nil {
			log.Fatal(err)
		}
	}
}
